// Samples of every shape against the densities it claims, and both against solid angles that are
// known in closed form.

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>

#include "../box.h"
#include "../quad.h"
#include "../sphere.h"
#include "shape_test_kit.h"

namespace pharos {
namespace {

/// Solid angle of a triangle (Van Oosterom and Strackee 1983), positive when `from` sees its
/// counter-clockwise side.
double solid_angle(Point3 from, Point3 p0, Point3 p1, Point3 p2) {
  const Vec3 a = normalize(p0 - from), b = normalize(p1 - from), c = normalize(p2 - from);
  const double volume = -dot(a, cross(b, c));
  return 2 * std::atan2(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Of all triangles of a convex mesh that face `from`.
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

/// The direction to a sample that faces `from`, as a draw of directions.
statistics::Draw<Vec3> draw_from(const Shape& shape, Point3 from, bool facing_only) {
  return [&shape, from, facing_only](RandomStream& random) -> std::optional<Vec3> {
    const ShapeSample s = shape.sample_from(from, random.next_2d());
    const Vec3 d = s.point.position - from;
    if (s.pdf == 0 || (facing_only && dot(d, s.point.normal) >= 0)) return std::nullopt;
    return normalize(d);
  };
}

/// The density of that draw, at the point that a ray finds.
statistics::Density<Vec3> density_from(const Scene& scene, const Shape& shape, Point3 from) {
  return [&scene, &shape, from](Vec3 direction) -> double {
    SurfacePoint point;
    if (scene.intersect({from, direction}, point) == kInfinity) return 0;
    return shape.pdf_from(from, point);
  };
}

template <class S>
void check_density(const typename S::Settings& settings, Point3 from, bool facing_only) {
  const S shape(settings);
  const auto scene = test::scene_of<S>(settings);
  const statistics::DensityFit fit = statistics::fit_direction_density(
      draw_from(shape, from, facing_only), density_from(*scene, shape, from),
      {.draws = 40'000, .cells = 60, .quadrature_tolerance = 1e-3});
  CHECK(fit.chi_square.p_value > 1e-4);
  CHECK(fit.integral + fit.missed == doctest::Approx(1).epsilon(0.02));
}

/// The mean of 1/pdf over samples that face `from`: the visible solid angle.
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
  check_density<Quad>({.to_world = sheared()}, {0, 0, 3}, false);
  check_density<Quad>({.to_world = sheared()}, {1, -0.5f, -0.5f}, false);
  check_density<Quad>({.to_world = sheared(), .flip_normals = true}, {-0.5f, 2, -4}, false);
}

TEST_CASE("samples of a box follow their density over directions") {
  check_density<Box>({.to_world = sheared()}, {4, 3, 2}, true);
  check_density<Box>({}, {0.5f, -0.2f, 0.7f}, false);
}

TEST_CASE("samples of a sphere follow their density over directions") {
  const Sphere::Settings sphere{.center = {1, 2, 3}, .radius = 0.5f};
  check_density<Sphere>(sphere, {1, 2, 5}, false);
  check_density<Sphere>(sphere, {1.3f, 2.4f, 3.1f}, false);  // close outside
  check_density<Sphere>(sphere, {1.1f, 2.2f, 2.9f}, false);  // inside
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

TEST_CASE("samples are uniform over the area") {
  // A box with faces of areas 24, 12 and 8 twice each: count points by face.
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
