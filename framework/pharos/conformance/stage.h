#pragma once

#include <functional>
#include <vector>

#include <pharos/scene/scene.h>

/// What subjects are tested on: parts of scenes that come with the suites, so that a plugin is
/// tested by itself.
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
  std::vector<double> area_up_to_;  ///< of each triangle and those before it
};

/// The parallelogram about `center` with half edges `u` and `v`; it faces u x v.
TriangleMesh square_mesh(Point3 center, Vec3 u, Vec3 v);
/// A ball of flat triangles with smooth shading normals.
TriangleMesh ball_mesh(Point3 center, float radius);
/// The cube [-1,1]^3 seen from inside.
TriangleMesh room_mesh();

/// A surface that scatters nothing.
Ref<Bsdf> black_bsdf();
/// A matt surface of the given reflectance on its outer side.
Ref<Bsdf> matt_bsdf(float reflectance);
/// Half of the light is mirrored, half passes straight through: discrete events without loss.
Ref<Bsdf> half_mirror();
/// Radiance `radiance` from a shape's outer side.
Ref<Emitter> glow(float radiance);
/// A pinhole at `at` that looks along +z.
Ref<Sensor> pinhole(Point3 at);
/// A medium that only scatters, evenly in all directions, `density` times a meter.
Ref<Medium> fog(float density);

/// One object of its own in an otherwise empty scene.
SceneParts alone(Ref<Shape> shape, Ref<Emitter> emitter = nullptr);

/// The sum of `value(point)` over all surface points along a ray.
double sum_along(const Scene& scene, Ray ray,
                 const std::function<double(const SurfacePoint&)>& value);

/// Whether a point is seen neither edge-on, where densities over solid angle grow without bound and
/// quadrature fails, nor from itself. Tests of densities treat all others as not there.
bool is_well_seen(Point3 from, const SurfacePoint& point);

}  // namespace pharos::conformance
