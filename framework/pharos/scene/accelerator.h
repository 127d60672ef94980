#pragma once

#include <memory>
#include <vector>

#include <pharos/scene/placement.h>
#include <pharos/scene/scene.h>

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCRayHit;

namespace pharos {

/// Answers the scene's ray queries with Embree. There is one Embree scene for the world and one for
/// each group. Geometries are numbered like Scene::objects(): the objects that stand in the world
/// themselves come first. In the world's Embree scene, the instances follow these objects.
class Scene::Accelerator {
 public:
  /// Builds the hierarchies. The result does not depend on the number of threads. The shapes must
  /// outlive the accelerator. Throws RunError if Embree cannot build the scene.
  explicit Accelerator(const SceneParts& parts);
  ~Accelerator();

  /// See Scene::intersect().
  float intersect(const Ray& ray, SurfacePoint& point) const;
  /// See Scene::occluded().
  bool occluded(const Ray& ray) const;

 private:
  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
  };
  /// The geometry of an object. `mesh` saves virtual calls for triangle meshes; it is null for
  /// analytic shapes.
  struct Geometry {
    const TriangleMesh* mesh;
    const Shape* shape;
    bool needs_tangents;  ///< whether its BSDF needs tangents
  };

  struct Instance {
    Placement placement;
    std::uint32_t first_object;  ///< first object of its group in `geometries_`
  };
  using EmbreeScene = std::unique_ptr<RTCSceneTy, Release>;

  void build(const SceneParts& parts);
  /// Gives the objects of a failed build up without releasing them: if memory ran out in a build,
  /// Embree would wait for ever for its tasks. They stay until the process ends.
  void abandon() noexcept;
  /// Returns an uncommitted Embree scene of these objects and appends them to `geometries_`.
  EmbreeScene scene_of(const std::vector<SceneObject>& objects);
  void add_instances(const SceneParts& parts);
  /// Fills `point` with a hit on an instance.
  void instance_point(const Ray& ray, const RTCRayHit& hit, SurfacePoint& point) const;

  std::vector<Geometry> geometries_;  ///< indexed by object
  std::vector<Instance> instances_;
  std::uint32_t world_objects_ = 0;  ///< number of objects that stand in the world themselves
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::vector<EmbreeScene> groups_;
  EmbreeScene scene_;
};

}  // namespace pharos
