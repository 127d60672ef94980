// Compares the samples of every shape with the densities it returns, and both with solid angles
// that are known in closed form.

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>

#include "../box.h"
#include "../cylinder.h"
#include "../disk.h"
#include "../lathe.h"
#include "../quad.h"
#include "../sphere.h"
#include "shape_test_kit.h"

namespace pharos {
namespace {

/// Returns the solid angle of a triangle (Van Oosterom and Strackee 1983), positive if `from` sees
/// its counter-clockwise side.
double solid_angle(Point3 from, Point3 p0, Point3 p1, Point3 p2) {
  const Vec3 a = normalize(p0 - from), b = normalize(p1 - from), c = normalize(p2 - from);
  const double volume = -dot(a, cross(b, c));
  return 2 * std::atan2(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Returns the solid angle of all triangles of a convex mesh that face `from`.
double visible_solid_angle(Point3 from, const TriangleMesh& mesh) {
  double total = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    total +=
        std::max(0.0, solid_angle(from, mesh.positions[a], mesh.positions[b], mesh.positions[c]));
  }
  return total;
}

Transform sheared() {
  return Transform({{{1.5f, 0.4f, 0.2f, 0.3f}, {0, 0.8f, -0.3f, 1}, {0.1f, 0.2f, 1.1f, -2}}});
}

/// Draws the direction to a sample. Samples that the shape itself hides are rejected.
statistics::Draw<Vec3> draw_from(const Scene& scene, const Shape& shape, Point3 from) {
  return [&scene, &shape, from](RandomStream& random) -> std::optional<Vec3> {
    const ShapeSample s = shape.sample_from(from, random.next_2d());
    const Vec3 d = s.point.position - from;
    const float distance = length(d);
    if (s.pdf == 0 || scene.occluded({from, d / distance, 0.999f * distance})) return std::nullopt;
    return d / distance;
  };
}

/// Returns the density of that draw, at the point that a ray finds.
statistics::Density<Vec3> density_from(const Scene& scene, const Shape& shape, Point3 from) {
  return [&scene, &shape, from](Vec3 direction) -> double {
    SurfacePoint point;
    if (scene.intersect({from, direction}, point) == kInfinity) return 0;
    return shape.pdf_from(from, point);
  };
}

template <class S>
void check_density(const typename S::Settings& settings, Point3 from) {
  const S shape(settings);
  const auto scene = test::scene_of<S>(settings);
  const statistics::DensityFit fit = statistics::fit_direction_density(
      draw_from(*scene, shape, from), density_from(*scene, shape, from),
      {.draws = 40'000, .cells = 60, .quadrature_tolerance = 1e-3});
  CHECK(fit.chi_square.p_value > 1e-4);
  CHECK(fit.integral + fit.missed == doctest::Approx(1).epsilon(0.02));
}

/// Returns the mean of 1/pdf over samples that face `from`, which is the visible solid angle.
double estimated_solid_angle(const Shape& shape, Point3 from, bool facing_only) {
  constexpr int count = 400;
  double sum = 0;
  for (int i = 0; i < count * count; ++i) {
    const Vec2 u{(i % count + 0.5f) / count, (i / count + 0.5f) / count};
    const ShapeSample s = shape.sample_from(from, u);
    if (facing_only && dot(s.point.position - from, s.point.normal) >= 0) continue;
    sum += 1 / static_cast<double>(s.pdf);
    CHECK_MESSAGE(shape.pdf_from(from, s.point) == doctest::Approx(s.pdf).epsilon(1e-3), i);
  }
  return sum / (count * count);
}

TEST_CASE("samples of a quad follow their density over directions") {
  check_density<Quad>({.to_world = sheared()}, {0, 0, 3});
  check_density<Quad>({.to_world = sheared()}, {1, -0.5f, -0.5f});
  check_density<Quad>({.to_world = sheared(), .flip_normals = true}, {-0.5f, 2, -4});
}

TEST_CASE("samples of a box follow their density over directions") {
  check_density<Box>({.to_world = sheared()}, {4, 3, 2});
  check_density<Box>({}, {0.5f, -0.2f, 0.7f});
}

TEST_CASE("samples of a sphere follow their density over directions") {
  const Sphere::Settings sphere{.center = {1, 2, 3}, .radius = 0.5f};
  check_density<Sphere>(sphere, {1, 2, 5});
  check_density<Sphere>(sphere, {1.3f, 2.4f, 3.1f});  // close outside
  check_density<Sphere>(sphere, {1.1f, 2.2f, 2.9f});  // inside
}

TEST_CASE("samples of a disk follow their density over directions") {
  check_density<Disk>({}, {0.2f, 0.1f, 0.3f});
  check_density<Disk>({.to_world = sheared()}, {0, 0, 3});
  check_density<Disk>({.to_world = sheared(), .flip_normals = true}, {-0.5f, 2, -4});
}

TEST_CASE("samples of a cylinder follow their density over directions") {
  const Cylinder::Settings tube{.p0 = {1, 2, 3}, .p1 = {1.5f, 1, 3.5f}, .radius = 0.4f};
  check_density<Cylinder>(tube, {2.5f, 2.5f, 4});
  check_density<Cylinder>(tube, {1.2f, 1.5f, 3.2f});  // inside
  Cylinder::Settings lamp = tube;
  lamp.flip_normals = true;
  check_density<Cylinder>(lamp, {0.7f, 3, 2.7f});  // along the axis into the tube
  check_density<Cylinder>(lamp, {1.2f, 1.5f, 3.2f});
}

TEST_CASE("samples of a lathe follow their density over directions") {
  const std::vector<Vec2> spindle{{0, -1}, {1, 0}, {0, 1}};
  check_density<Lathe>({.profile = spindle, .segments = 7}, {0.1f, 0.2f, -0.1f});
  check_density<Lathe>({.profile = spindle, .segments = 7, .to_world = sheared()}, {4, 3, 2});
}

TEST_CASE("a disk's density integrates to its solid angle on the axis") {
  // The cone of the rim has the solid angle 2 pi (1 - cos).
  const Disk disk(Disk::Settings{.to_world = Transform::scale({2, 2, 2})});
  for (const double height : {0.5, 2.0, 50.0}) {
    const double exact = 2 * std::acos(-1.0) * (1 - height / std::sqrt(height * height + 4));
    CHECK(estimated_solid_angle(disk, {0, 0, static_cast<float>(height)}, false) ==
          doctest::Approx(exact).epsilon(1e-3));
  }
}

TEST_CASE("a cylinder's density integrates to the solid angle of the side that faces the point") {
  // From the axis, inside: the sphere minus both openings.
  const Cylinder inside(Cylinder::Settings{.radius = 0.5f, .flip_normals = true});
  const double opening = 2 * std::acos(-1.0) * (1 - 1 / std::sqrt(1.25));
  CHECK(estimated_solid_angle(inside, {}, true) ==
        doctest::Approx(4 * std::acos(-1.0) - 2 * opening).epsilon(1e-3));
  // From far outside, level with the middle: the silhouette is a rectangle.
  const Cylinder outside(Cylinder::Settings{.radius = 0.5f});
  CHECK(estimated_solid_angle(outside, {500, 0, 0}, true) ==
        doctest::Approx(1.0 * 2.0 / (500 * 500)).epsilon(3e-3));
  // From there no sample faces away.
  const Point3 from{2, 1, 0.3f};
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u{(i % 40 + 0.5f) / 40, (i / 40 + 0.5f) / 25};
    const SurfacePoint p = outside.sample_from(from, u).point;
    CHECK(dot(from - p.position, p.normal) > 0);
    const SurfacePoint any = outside.sample(u).point;
    CHECK((outside.pdf_from(from, any) > 0) == (dot(from - any.position, any.normal) > 0));
  }
}

TEST_CASE("a quad's density integrates to its solid angle") {
  const Quad quad(Quad::Settings{.to_world = sheared()});
  for (const Point3 from : {Point3{0, 0, 3}, Point3{0.3f, 1, -1.5f}, Point3{300, 200, 100}}) {
    const TriangleMesh& m = *quad.mesh();
    double exact = 0;
    for (const auto& [a, b, c] : m.triangles) {
      exact += std::abs(solid_angle(from, m.positions[a], m.positions[b], m.positions[c]));
    }
    const double tolerance = length(from) > 100 ? 0.02 : 1e-3;  // of the closed form in float
    CHECK(estimated_solid_angle(quad, from, false) == doctest::Approx(exact).epsilon(tolerance));
  }
}

TEST_CASE("a box's density integrates to its visible solid angle, from inside to the sphere") {
  const Box box(Box::Settings{.to_world = sheared()});
  const Point3 outside{4, 3, 2};
  CHECK(estimated_solid_angle(box, outside, true) ==
        doctest::Approx(visible_solid_angle(outside, *box.mesh())).epsilon(2e-3));
  const Box room(Box::Settings{.flip_normals = true});
  CHECK(estimated_solid_angle(room, {0.3f, -0.2f, 0.1f}, true) ==
        doctest::Approx(4 * kPi).epsilon(2e-3));
}

TEST_CASE("a sphere's density integrates to its solid angle, near, far and inside") {
  const Sphere sphere(Sphere::Settings{.radius = 2});
  for (const float distance : {2.0001f, 2.5f, 10.0f, 1e3f, 2e6f}) {
    const double s = 2.0 / distance;
    const double exact = 2 * std::acos(-1.0) * s * s / (1 + std::sqrt(1 - s * s));
    CHECK(estimated_solid_angle(sphere, {0, distance, 0}, false) ==
          doctest::Approx(exact).epsilon(1e-3));
  }
  CHECK(estimated_solid_angle(sphere, {0.5f, 0.3f, -0.8f}, false) ==
        doctest::Approx(4 * kPi).epsilon(2e-3));
}

/// Counts samples in 8 x 8 cells of equal area, which `cell` maps to [0,1]^2.
template <class Cell>
void check_uniform_over_area(const Shape& shape, const Cell& cell) {
  RandomStream random(3);
  constexpr int count = 100'000, side = 8;
  std::vector<double> seen(side * side), expected(side * side, double{count} / (side * side));
  for (int i = 0; i < count; ++i) {
    const ShapeSample s = shape.sample(random.next_2d());
    CHECK(s.pdf == 1 / shape.area());
    const Vec2 at = cell(s.point);
    const auto x = static_cast<std::size_t>(std::clamp(at.x * side, 0.0f, side - 1.0f));
    const auto y = static_cast<std::size_t>(std::clamp(at.y * side, 0.0f, side - 1.0f));
    seen[y * side + x] += 1;
  }
  CHECK(statistics::chi_square_test(seen, expected).p_value > 1e-4);
}

TEST_CASE("samples of exact shapes are uniform over the area, sheared too") {
  const Transform map = sheared();
  check_uniform_over_area(Disk(Disk::Settings{.to_world = map}), [&](const SurfacePoint& p) {
    const Point3 local = map.inverse_point(p.position);  // equal areas: radius^2 and azimuth
    return Vec2{local.x * local.x + local.y * local.y,
                0.5f + std::atan2(local.y, local.x) / (2 * kPi)};
  });
  const Cylinder::Settings tube{.p0 = {3, 2, 1}, .p1 = {-1, 0, 5}, .radius = 3};
  check_uniform_over_area(Cylinder(tube), [](const SurfacePoint& p) { return p.uv; });
}

TEST_CASE("samples are uniform over the area") {
  // A box whose faces have the areas 24, 12 and 8, twice each. Counts points by face.
  const Box box(Box::Settings{.to_world = Transform::scale({1, 2, 3})});
  CHECK(box.area() == doctest::Approx(88));
  RandomStream random(3);
  std::vector<double> seen(6 * 16), expected;
  constexpr int count = 100'000;
  for (int i = 0; i < count; ++i) {
    const ShapeSample s = box.sample(random.next_2d());
    CHECK(s.pdf == 1 / box.area());
    const auto cell = static_cast<std::size_t>(std::min(s.point.uv.x * 4, 3.0f)) * 4 +
                      static_cast<std::size_t>(std::min(s.point.uv.y * 4, 3.0f));
    seen[s.point.primitive / 2 * 16 + cell] += 1;
  }
  for (const double area : {24.0, 24.0, 12.0, 12.0, 8.0, 8.0}) {
    for (int i = 0; i < 16; ++i) expected.push_back(count * area / 88 / 16);
  }
  CHECK(statistics::chi_square_test(seen, expected).p_value > 1e-4);
}

TEST_CASE("a quad's samples are affine in the random numbers") {
  for (const bool flip : {false, true}) {
    for (const float mirror : {1.0f, -1.0f}) {
      const Transform map = sheared() * Transform::scale({mirror, 1, 1});
      const Quad quad(Quad::Settings{.to_world = map, .flip_normals = flip});
      for (const Vec2 u : {Vec2{0.25f, 0.5f}, Vec2{0.75f, 0.125f}, Vec2{0.5f, 0.5f}}) {
        const SurfacePoint p = quad.sample(u).point;
        CHECK(length(p.position - map.point({2 * u.x - 1, 2 * u.y - 1, 0})) <= 2 * p.error);
        CHECK(p.uv.x == doctest::Approx(u.x));
        CHECK(p.uv.y == doctest::Approx(u.y));
        const Vec3 outer = normalize(map.normal({0, 0, flip ? -1.0f : 1.0f}));
        CHECK(dot(p.normal, outer) == doctest::Approx(1));
      }
    }
  }
}

TEST_CASE("a box's normals point outwards, mirrored or not") {
  for (const float mirror : {1.0f, -1.0f}) {
    for (const bool flip : {false, true}) {
      const Transform map = sheared() * Transform::scale({1, mirror, 1});
      const Box box(Box::Settings{.to_world = map, .flip_normals = flip});
      for (std::uint32_t i = 0; i < 12; ++i) {
        const SurfacePoint p = box.mesh()->surface_point(i, 0.3f, 0.3f);
        const float outwards = dot(p.normal, p.position - map.point({}));
        CHECK((outwards > 0) == !flip);
      }
    }
  }
}

}  // namespace
}  // namespace pharos
