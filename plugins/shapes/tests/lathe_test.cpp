#include "../lathe.h"

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "shape_test_kit.h"

namespace pharos {
namespace {

using Profile = std::vector<Vec2>;

const Profile kSpindle{{0, -1}, {1, 0}, {0, 1}};
/// A closed ring of square cross section around the circle of radius 2.
const Profile kRing{{1.5f, -0.5f}, {2.5f, -0.5f}, {2.5f, 0.5f}, {1.5f, 0.5f}, {1.5f, -0.5f}};

Profile half_circle(int points) {
  Profile all;
  for (int i = 0; i <= points; ++i) {
    const double angle = std::acos(-1.0) * i / points;
    const bool on_axis = i == 0 || i == points;
    all.push_back(
        {on_axis ? 0 : static_cast<float>(std::sin(angle)), static_cast<float>(-std::cos(angle))});
  }
  return all;
}

std::string refusal(const Profile& profile) {
  return test::input_error([&] { Lathe({.profile = profile}); });
}

/// Returns the volume enclosed by the triangles if their outer side faces outwards (divergence
/// theorem).
double enclosed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])) / 6;
  }
  return volume;
}

TEST_CASE("a lathe's area and volume approach those of the frustum it stands for") {
  // A frustum of height 1.5 with radii from 2 to 1, with both lids.
  const Profile frustum{{0, 0}, {2, 0}, {1, 1.5f}, {0, 1.5f}};
  const double pi = std::acos(-1.0);
  const double area = pi * (4 + 1) + pi * (2 + 1) * std::hypot(1.0, 1.5);
  const double volume = pi * 1.5 * (4 + 2 + 1) / 3;
  const Lathe fine({.profile = frustum, .segments = 2000});
  CHECK(fine.area() == doctest::Approx(area).epsilon(1e-5));
  CHECK(enclosed_volume(*fine.mesh()) == doctest::Approx(volume).epsilon(1e-4));
  CHECK(fine.primitive_count() == 2000 * 4);  // one triangle per facet for each lid, two per facet
                                              // for the side
  // With n facets the area and volume are those of the inscribed polygon.
  const Lathe coarse({.profile = frustum, .segments = 6});
  CHECK(enclosed_volume(*coarse.mesh()) ==
        doctest::Approx(volume * 6 * std::sin(2 * pi / 6) / (2 * pi)));
}

TEST_CASE("the outer side of a lathe lies on the right of its profile, flipped and mirrored too") {
  for (const Profile& profile : {kSpindle, kRing}) {
    for (const float mirror : {1.0f, -1.0f}) {
      for (const bool flip : {false, true}) {
        const Lathe lathe({.profile = profile,
                           .to_world = Transform::scale({1, mirror, 1}),
                           .flip_normals = flip});
        CHECK((enclosed_volume(*lathe.mesh()) > 0) == !flip);
        for (std::uint32_t i = 0; i < lathe.primitive_count(); ++i) {
          const auto [a, b, c] = lathe.mesh()->triangles[i];
          const Vec3 facet = lathe.mesh()->surface_point(i, 0.3f, 0.3f).normal;
          for (const std::uint32_t corner : {a, b, c}) {
            CHECK(dot(lathe.mesh()->normals[corner], facet) > 0.5f);
          }
        }
      }
    }
  }
}

TEST_CASE("no ray from inside leaves a closed lathe") {
  const Profile touching{{0, -1}, {0.8f, -0.5f}, {0, 0}, {0.8f, 0.5f}, {0, 1}};
  for (const Profile& profile : {kSpindle, kRing, touching, half_circle(9)}) {
    for (const auto interpolation :
         {ProfileInterpolation::linear, ProfileInterpolation::catmull_rom}) {
      const auto scene = test::scene_of<Lathe>(
          {.profile = profile, .segments = 11, .interpolation = interpolation, .subdivisions = 3});
      RandomStream random(6);
      const Shape& shape = *scene->objects()[0].shape;
      int leaks = 0;
      for (int i = 0; i < 20'000; ++i) {
        const SurfacePoint p = shape.sample(random.next_2d()).point;
        const Vec3 inwards = test::random_departure(-p.normal, random);
        if (!scene->occluded({p.origin_towards(inwards), inwards})) ++leaks;
      }
      CHECK(leaks == 0);
    }
  }
}

TEST_CASE("points on the axis make no triangles without area, nor do pieces along it") {
  const Profile cone{{0, 0}, {1, 0}, {0, 1}, {0, 0}};  // closed along the axis
  const Lathe lathe({.profile = cone, .segments = 10});
  CHECK(lathe.primitive_count() == 20);
  for (std::uint32_t i = 0; i < 20; ++i) CHECK(lathe.mesh()->area(i) > 0.01f);
}

TEST_CASE("smooth normals follow the curve but for creases") {
  // On a sphere the normals point away from the center, at the poles too.
  const Lathe ball({.profile = half_circle(32), .crease = 30});
  for (std::size_t i = 0; i < ball.mesh()->positions.size(); ++i) {
    // On the axis each vertex serves one facet only, at the azimuth of its middle.
    CHECK(dot(ball.mesh()->normals[i], normalize(ball.mesh()->positions[i])) > 0.99999f);
  }
  // The corners of a ring of square cross section stay sharp, or become round if requested.
  const Lathe sharp({.profile = kRing});
  for (const Vec3 n : sharp.mesh()->normals) {
    CHECK(std::max(std::abs(n.z), std::hypot(n.x, n.y)) == doctest::Approx(1));
  }
  const Lathe round({.profile = kRing, .crease = 91});
  for (const Vec3 n : round.mesh()->normals)
    CHECK(std::abs(n.z) == doctest::Approx(std::sqrt(0.5)));
  // The tip of a cone stays sharp, and the middles of its facets have the correct slope.
  const Lathe cone({.profile = {{1, 0}, {0, 1}}});
  for (const Vec3 n : cone.mesh()->normals) CHECK(n.z == doctest::Approx(std::sqrt(0.5)));
  CHECK(Lathe({.profile = kSpindle, .smooth = false}).mesh()->normals.empty());
}

TEST_CASE("texture coordinates are azimuth and arc length") {
  const auto scene = test::scene_of<Lathe>({.profile = {{1, 0}, {1, 2}, {2, 2}}, .segments = 64});
  SurfacePoint p;
  scene->intersect({{0, 0.001f, 1}, {1, 0, 0}}, p);
  CHECK(p.uv.x == doctest::Approx(0.001 / (2 * kPi)).epsilon(0.01));
  CHECK(p.uv.y == doctest::Approx(1.0 / 3));
  scene->intersect({{0, 1.5f, 4}, {0, 0, -1}}, p);
  CHECK(p.uv.x == doctest::Approx(0.25));
  CHECK(p.uv.y == doctest::Approx(2.5 / 3).epsilon(1e-3));
  scene->intersect({{0.001f, 0, 1}, {0, -1, 0}}, p);
  CHECK(p.uv.x == doctest::Approx(0.75).epsilon(1e-3));
}

TEST_CASE("the spline runs through all points and stays close to the circle they lie on") {
  const Profile points = half_circle(8);
  const Lathe lathe({.profile = points,
                     .segments = 4,
                     .interpolation = ProfileInterpolation::catmull_rom,
                     .subdivisions = 10});
  const auto& positions = lathe.mesh()->positions;
  for (const Vec2 p : points) {
    const bool met = std::any_of(positions.begin(), positions.end(), [&](Point3 q) {
      return std::hypot(q.x, q.y) == doctest::Approx(p.x) && q.z == p.y;
    });
    CHECK(met);
  }
  for (const Point3 p : positions) CHECK(length(p) == doctest::Approx(1).epsilon(0.003));
  // Where the curve would cross the axis, it follows the axis.
  const Lathe dip({.profile = {{3, 0}, {0.01f, 1}, {0.01f, 1.1f}, {3, 2}},
                   .interpolation = ProfileInterpolation::catmull_rom});
  CHECK(dip.area() > 0);
}

TEST_CASE("profiles that enclose no surface are refused, naming the point") {
  CHECK(refusal({}) == "lathe: 'profile' needs at least two points");
  CHECK(refusal({{1, 0}}) == "lathe: 'profile' needs at least two points");
  CHECK(refusal({{1, 0}, {-0.1f, 1}}) == "lathe: point 1 of 'profile' has a negative r");
  CHECK(refusal({{1, 0}, {2, 1}, {2, 1}}) == "lathe: point 2 of 'profile' repeats the one before");
  CHECK(refusal({{1, 0}, {2, 1}, {1, 0}}) ==
        "lathe: a closed 'profile' needs at least three different points");
  CHECK(Lathe({.profile = {{0, 0}, {0, 1}}}).area() == 0);
  const std::string large = test::input_error([] {
    Lathe({.profile = kSpindle,
           .segments = 65536,
           .interpolation = ProfileInterpolation::catmull_rom,
           .subdivisions = 65536});
  });
  CHECK(large.find("triangles; at most") != std::string::npos);
}

}  // namespace
}  // namespace pharos
