#pragma once

#include <memory>
#include <vector>

#include <pharos/scene/scene.h>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace pharos {

/// Embree behind two questions. Knows each object's geometry under the object's own index.
class Scene::Accelerator {
 public:
  /// Builds the hierarchy; the result does not depend on the number of threads. The shapes must
  /// outlive it. Throws RunError when Embree cannot do it.
  explicit Accelerator(const std::vector<SceneObject>& objects);
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
  };

  std::vector<Geometry> geometries_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace pharos
