#pragma once

#include <memory>
#include <span>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/ray.h>
#include <pharos/core/transform.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/medium.h>
#include <pharos/scene/sensor.h>
#include <pharos/scene/shape.h>

namespace pharos {

/// A shape with what it is made of. `emitter`, `interior` and `exterior` may be null.
struct SceneObject {
  Ref<Shape> shape;
  Ref<Bsdf> bsdf;
  Ref<Emitter> emitter;
  Ref<Medium> interior;  ///< on the side away from the normal; null: empty
  Ref<Medium> exterior;  ///< on the side of the normal; null: empty
};

/// Objects in a space of their own, to be placed as a whole any number of times. None may have an
/// emitter.
struct SceneGroup {
  std::vector<SceneObject> objects;
};

/// A group that stands somewhere. All instances of a group share its memory.
struct SceneInstance {
  std::uint32_t group = 0;  ///< index into SceneParts::groups
  Transform to_world = {};
};

/// The parts of a scene.
struct SceneParts {
  std::vector<SceneObject> objects;  ///< those that stand in the world themselves
  std::vector<SceneGroup> groups;    ///< seen only where there are instances of them
  std::vector<SceneInstance> instances;
  std::vector<Ref<Emitter>> emitters;  ///< those that stand alone
  Ref<Sensor> sensor;                  ///< null: none; Scene::sensor() must not be called
  Ref<Medium> medium;                  ///< around the sensor; null: empty
};

/// Geometry, materials and lights, ready for rays. Immutable and thread-safe.
class Scene {
 public:
  /// Builds the acceleration structure; the result does not depend on the number of threads. Throws
  /// InputError when an instance lies beyond what a float can hold.
  explicit Scene(SceneParts parts);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The nearest surface with 0 < t < ray.t_max. On success fills `point` and returns the
  /// distance; otherwise returns infinity.
  float intersect(const Ray& ray, SurfacePoint& point) const;
  /// Whether anything lies on the ray before ray.t_max.
  bool occluded(const Ray& ray) const;

  /// The objects that stand in the world themselves, then those of the groups, each once: the shape
  /// of one that belongs to a group is in the group's space.
  const std::vector<SceneObject>& objects() const { return objects_; }
  const Bsdf& bsdf(const SurfacePoint& point) const { return *objects_[point.object].bsdf; }
  /// The light on the object that `point` lies on; null when it has none.
  const Light* light_at(const SurfacePoint& point) const { return object_lights_[point.object]; }
  /// Index into lights() of the light of an object; -1 when it has none.
  int light_index(const SurfacePoint& point) const { return object_light_index_[point.object]; }
  /// The medium that a ray leaving `point` towards `direction` is in (null: empty space) when the
  /// ray that arrived there came through `current`. Only objects with an interior or exterior
  /// bound media.
  const Medium* medium_after(const SurfacePoint& point, Vec3 direction,
                             const Medium* current) const {
    if (!has_media_) return nullptr;
    const SceneObject& o = objects_[point.object];
    if (o.interior == nullptr && o.exterior == nullptr) return current;
    return dot(direction, point.normal) >= 0 ? o.exterior.get() : o.interior.get();
  }

  std::span<const std::unique_ptr<const Light>> lights() const { return lights_; }
  /// Indices into lights() of those that rays leaving the scene meet.
  std::span<const int> environment_lights() const { return environment_lights_; }
  const Sensor& sensor() const { return *sensor_; }
  /// The medium around the sensor; null: empty.
  const Medium* sensor_medium() const { return medium_.get(); }
  /// The medium at a point: what a walk straight from the sensor ends in.
  const Medium* medium_at(Point3 point) const;
  bool has_media() const { return has_media_; }
  /// Whether a surface does nothing but let all light pass, straight on: it only bounds media.
  bool is_boundary(const SurfacePoint& point) const {
    return has_boundaries_ && object_is_boundary_[point.object] != 0;
  }
  bool has_boundaries() const { return has_boundaries_; }

  /// Box of all geometry and the sensor [scene units].
  const Bounds3& bounds() const { return bounds_; }
  /// The stand-in for what is infinitely far away: outside the scene, along `direction`.
  Point3 environment_point(Point3 from, Vec3 direction) const {
    return from + 2 * bounds_.diagonal() * direction;
  }
  /// Triangles and analytic primitives together; those of a group count once.
  std::size_t primitive_count() const;

 private:
  class Accelerator;

  void place_lights();

  std::vector<SceneObject> objects_;
  std::vector<Ref<Emitter>> emitters_;
  Ref<Sensor> sensor_;
  Ref<Medium> medium_;
  Bounds3 geometry_bounds_;
  Bounds3 bounds_;
  std::unique_ptr<const Accelerator> accelerator_;
  std::vector<std::unique_ptr<const Light>> lights_;
  std::vector<const Light*> object_lights_;
  std::vector<int> object_light_index_;
  std::vector<int> environment_lights_;
  std::vector<std::uint8_t> object_is_boundary_;
  bool has_media_ = false;
  bool has_boundaries_ = false;
};

}  // namespace pharos
