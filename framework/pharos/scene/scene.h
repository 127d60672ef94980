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

/// A shape with its materials and media. `emitter`, `interior` and `exterior` may be null.
struct SceneObject {
  Ref<Shape> shape;
  Ref<Bsdf> bsdf;
  Ref<Emitter> emitter;
  Ref<Medium> interior;  ///< on the side away from the normal; null: empty space
  Ref<Medium> exterior;  ///< on the side of the normal; null: empty space
};

/// Objects in a space of their own, which can be placed as a whole any number of times. None of
/// them may have an emitter.
struct SceneGroup {
  std::vector<SceneObject> objects;
};

/// A group at one place in the world. All instances of a group share its memory.
struct SceneInstance {
  std::uint32_t group = 0;  ///< index into SceneParts::groups
  Transform to_world = {};
};

/// The parts of a scene.
struct SceneParts {
  std::vector<SceneObject> objects;  ///< objects that stand in the world themselves
  std::vector<SceneGroup> groups;    ///< visible only through their instances
  std::vector<SceneInstance> instances;
  std::vector<Ref<Emitter>> emitters;  ///< emitters without a shape
  Ref<Sensor> sensor;                  ///< null: no sensor; Scene::sensor() must not be called
  Ref<Medium> medium;                  ///< around the sensor; null: empty space
};

/// Geometry, materials and lights, ready for ray queries. Immutable and thread-safe.
class Scene {
 public:
  /// Builds the acceleration structure. The result does not depend on the number of threads. Throws
  /// InputError if an instance lies beyond the range of a float.
  explicit Scene(SceneParts parts);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Finds the nearest surface with 0 < t < ray.t_max. On success fills `point` and returns the
  /// distance; otherwise returns infinity.
  float intersect(const Ray& ray, SurfacePoint& point) const;
  /// Whether anything lies on the ray before ray.t_max.
  bool occluded(const Ray& ray) const;

  /// The objects that stand in the world themselves, followed by the objects of the groups, each
  /// once. The shape of a group's object is in the group's space.
  const std::vector<SceneObject>& objects() const { return objects_; }
  const Bsdf& bsdf(const SurfacePoint& point) const { return *facts_[point.object].bsdf; }
  /// Bsdf::events() of the BSDF at `point`.
  EventMask events(const SurfacePoint& point) const { return facts_[point.object].events; }
  /// The light on the object that `point` lies on; null if it has none.
  const Light* light_at(const SurfacePoint& point) const { return facts_[point.object].light; }
  /// The index in lights() of the light on the object that `point` lies on; -1 if it has none.
  int light_index(const SurfacePoint& point) const { return facts_[point.object].light_index; }
  /// Returns the medium of a ray that leaves `point` towards `direction`; null for empty space.
  /// `current` is the medium of the ray that arrived at `point`. Only objects with an interior or
  /// an exterior bound media.
  const Medium* medium_after(const SurfacePoint& point, Vec3 direction,
                             const Medium* current) const {
    if (!has_media_) return nullptr;
    const SceneObject& o = objects_[point.object];
    if (o.interior == nullptr && o.exterior == nullptr) return current;
    return dot(direction, point.normal) >= 0 ? o.exterior.get() : o.interior.get();
  }

  std::span<const std::unique_ptr<const Light>> lights() const { return lights_; }
  /// The indices in lights() of the lights that rays leaving the scene reach.
  std::span<const int> environment_lights() const { return environment_lights_; }
  const Sensor& sensor() const { return *sensor_; }
  /// The medium around the sensor; null for empty space.
  const Medium* sensor_medium() const { return medium_.get(); }
  /// The medium at a point. It is found by following a straight line from the sensor to the point.
  const Medium* medium_at(Point3 point) const;
  bool has_media() const { return has_media_; }
  /// Whether the surface only bounds media, so that all light passes straight through it.
  bool is_boundary(const SurfacePoint& point) const {
    return has_boundaries_ && facts_[point.object].is_boundary;
  }
  bool has_boundaries() const { return has_boundaries_; }

  /// The box of all geometry and the sensor [scene units].
  const Bounds3& bounds() const { return bounds_; }
  /// The stand-in for a point infinitely far away: outside the scene, along `direction`.
  Point3 environment_point(Point3 from, Vec3 direction) const {
    return from + 2 * bounds_.diagonal() * direction;
  }
  /// The number of triangles and analytic primitives. Those of a group count once.
  std::size_t primitive_count() const;

 private:
  class Accelerator;
  /// The properties of an object that paths need at every hit, in half a cache line.
  struct alignas(32) ObjectFacts {
    const Bsdf* bsdf;
    const Light* light = nullptr;
    int light_index = -1;
    EventMask events;
    bool is_boundary;
  };

  static ObjectFacts facts_of(const SceneObject& object);
  void place_lights();

  std::vector<SceneObject> objects_;
  std::vector<Ref<Emitter>> emitters_;
  Ref<Sensor> sensor_;
  Ref<Medium> medium_;
  Bounds3 geometry_bounds_;
  Bounds3 bounds_;
  std::unique_ptr<const Accelerator> accelerator_;
  std::vector<std::unique_ptr<const Light>> lights_;
  std::vector<ObjectFacts> facts_;  ///< indexed like objects_
  std::vector<int> environment_lights_;
  bool has_media_ = false;
  bool has_boundaries_ = false;
};

}  // namespace pharos
