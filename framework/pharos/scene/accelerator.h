#pragma once

#include <memory>
#include <vector>

#include <pharos/scene/placement.h>
#include <pharos/scene/scene.h>

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCRayHit;

namespace pharos {

/// Embree behind two questions: a scene of its own for every group, and one for the world. Knows
/// each geometry of the world by the index of its object; those of instances follow.
class Scene::Accelerator {
 public:
  /// Builds the hierarchies; the result does not depend on the number of threads. The shapes must
  /// outlive it. Throws RunError when Embree cannot do it.
  explicit Accelerator(const SceneParts& parts);
  ~Accelerator();

  /// As Scene::intersect().
  float intersect(const Ray& ray, SurfacePoint& point) const;
  /// As Scene::occluded().
  bool occluded(const Ray& ray) const;

 private:
  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
  };
  /// An object's geometry; `mesh` spares meshes the virtual calls.
  struct Geometry {
    const TriangleMesh* mesh;
    const Shape* shape;
    bool needs_tangents;  ///< its material does
  };

  struct Instance {
    Placement placement;
    std::uint32_t first_object;  ///< of its group
  };
  using EmbreeScene = std::unique_ptr<RTCSceneTy, Release>;

  /// A scene of these objects, still to be committed; adds them to `geometries_`.
  EmbreeScene scene_of(const std::vector<SceneObject>& objects);
  void add_instances(const SceneParts& parts);
  /// Fills `point` with the hit of an instance.
  void instance_point(const Ray& ray, const RTCRayHit& hit, SurfacePoint& point) const;

  std::vector<Geometry> geometries_;  ///< by object
  std::vector<Instance> instances_;
  std::uint32_t world_objects_ = 0;  ///< objects that stand in the world themselves
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::vector<EmbreeScene> groups_;
  EmbreeScene scene_;
};

}  // namespace pharos
