#pragma once

#include <functional>
#include <vector>

#include <pharos/scene/scene.h>

/// Parts of scenes that come with the suites, so that a plugin can be tested independently of
/// others.
namespace pharos::conformance {

/// A triangle mesh as a shape, sampled uniformly over its area.
class StageShape final : public Shape {
 public:
  explicit StageShape(TriangleMesh mesh);

  Bounds3 bounds() const override { return mesh_.bounds(); }
  float area() const override { return static_cast<float>(area_up_to_.back()); }
  const TriangleMesh* mesh() const override { return &mesh_; }
  ShapeSample sample(Vec2 u) const override;

 private:
  TriangleMesh mesh_;
  std::vector<double> area_up_to_;  ///< summed areas of all triangles up to each one
};

/// The parallelogram around `center` with half edges `u` and `v`. Its outer side faces u x v.
TriangleMesh square_mesh(Point3 center, Vec3 u, Vec3 v);
/// A ball of flat triangles with smooth shading normals.
TriangleMesh ball_mesh(Point3 center, float radius);
/// The cube [-1,1]^3, with the outer side inwards.
TriangleMesh room_mesh();

/// A surface that scatters nothing.
Ref<Bsdf> black_bsdf();
/// A matt surface of the given reflectance on its outer side.
Ref<Bsdf> matt_bsdf(float reflectance);
/// A surface that mirrors half of the light and lets the other half pass straight through, so its
/// events are discrete and lossless.
Ref<Bsdf> half_mirror();
/// An emitter of radiance `radiance` from a shape's outer side.
Ref<Emitter> glow(float radiance);
/// A pinhole camera at `at` that looks along +z.
Ref<Sensor> pinhole(Point3 at);
/// A medium that scatters isotropically with coefficient `density` [1/m] and absorbs nothing.
Ref<Medium> fog(float density);

/// A scene with a single object.
SceneParts alone(Ref<Shape> shape, Ref<Emitter> emitter = nullptr);

/// Returns the sum of `value(point)` over all surface points along a ray.
double sum_along(const Scene& scene, Ray ray,
                 const std::function<double(const SurfacePoint&)>& value);

/// Whether `point` is not seen edge-on and is not `from` itself. At such points densities over
/// solid angle grow without bound and quadrature fails, so tests of densities ignore them.
bool is_well_seen(Point3 from, const SurfacePoint& point);

}  // namespace pharos::conformance
