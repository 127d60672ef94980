#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/transform.h>

#include "fixtures.h"

using namespace pharos;

namespace {

void check_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
  CHECK(length(a - b) <= tolerance * (1 + length(b)));
}

Transform arbitrary() {
  return Transform::translate({1, -2, 3}) * Transform::rotate({1, 2, 3}, 40) *
         Transform::scale({2, 0.5f, -3});
}

}  // namespace

TEST_CASE("elementary transforms") {
  check_near(Transform().point({1, 2, 3}), {1, 2, 3}, 0);
  check_near(Transform::translate({1, 2, 3}).point({1, 1, 1}), {2, 3, 4}, 0);
  check_near(Transform::translate({1, 2, 3}).vector({1, 1, 1}), {1, 1, 1}, 0);
  check_near(Transform::scale({2, 3, 4}).point({1, 1, 1}), {2, 3, 4}, 0);
}

TEST_CASE("rotations are counter-clockwise, and exact for quarter turns") {
  check_near(Transform::rotate({0, 0, 5}, 90).vector({1, 0, 0}), {0, 1, 0}, 0);
  check_near(Transform::rotate({2, 0, 0}, 90).vector({0, 1, 0}), {0, 0, 1}, 0);
  check_near(Transform::rotate({0, 1, 0}, -270).vector({0, 0, 1}), {1, 0, 0}, 0);
  check_near(Transform::rotate({0, 0, 1}, 180).vector({1, 2, 3}), {-1, -2, 3}, 0);
  check_near(Transform::rotate({1, 1, 1}, 120).vector({1, 0, 0}), {0, 1, 0});
  check_near(Transform::rotate({0, 0, 1}, 30).vector({1, 0, 0}), {std::sqrt(0.75f), 0.5f, 0});
}

TEST_CASE("look_at points +z at the target, +y up and +x to the viewer's left") {
  const Transform t = Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 2, 0});
  check_near(t.point({0, 0, 0}), {0, 0, 5});
  check_near(t.vector({0, 0, 1}), {0, 0, -1});
  check_near(t.vector({0, 1, 0}), {0, 1, 0});
  check_near(t.vector({1, 0, 0}), {-1, 0, 0});
  CHECK_FALSE(t.flips_handedness());
  const Transform tilted = Transform::look_at({1, 2, 3}, {4, 6, 3}, {0, 1, 0});
  check_near(tilted.vector({0, 0, 1}), {0.6f, 0.8f, 0});
  CHECK(tilted.vector({0, 1, 0}).y > 0);
}

TEST_CASE("products apply the right factor first") {
  const Transform t = Transform::translate({1, 0, 0}) * Transform::scale({2, 2, 2});
  check_near(t.point({1, 1, 1}), {3, 2, 2}, 0);
}

TEST_CASE("inverses undo points and vectors") {
  const Transform t = arbitrary();
  RandomStream random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p{random.next_1d() * 10, random.next_1d() * 10, random.next_1d() * 10};
    check_near(t.inverse_point(t.point(p)), p);
    check_near(t.inverse_vector(t.vector(p)), p);
  }
}

TEST_CASE("normals stay perpendicular to their surface") {
  const Transform t = arbitrary();
  const Vec3 tangent{1, 2, 0.5f}, bitangent{0, 1, -1};
  const Vec3 normal = normalize(t.normal(cross(tangent, bitangent)));
  CHECK(std::abs(dot(normal, normalize(t.vector(tangent)))) < 1e-6f);
  CHECK(std::abs(dot(normal, normalize(t.vector(bitangent)))) < 1e-6f);
}

TEST_CASE("handedness flips with an odd number of mirrors") {
  CHECK(arbitrary().flips_handedness());
  CHECK_FALSE((arbitrary() * arbitrary()).flips_handedness());
  CHECK_FALSE(Transform::scale({-1, -1, 1}).flips_handedness());
}

TEST_CASE("a transform made again from its matrix is the same in every bit") {
  const Transform t = arbitrary();
  const Transform again(t.matrix());
  const Vec3 p{0.3f, -7.1f, 1e3f};
  CHECK(again.point(p) == t.point(p));
  CHECK(again.inverse_point(p) == t.inverse_point(p));
  CHECK((Transform() * t).matrix() == t.matrix());
}

TEST_CASE("what cannot be inverted is refused, however small or large the rest") {
  const auto message = [](auto make) { return test::input_error(make); };
  const std::string singular = "the transform cannot be inverted";
  CHECK(message([] { return Transform::scale({1, 0, 1}); }) == singular);
  CHECK(message([] {
          return Transform({{{1, 2, 3, 0}, {2, 4, 6, 0}, {0, 0, 1, 0}}});
        }) == singular);
  CHECK(message([] {
          return Transform({{{0.1f, 0.3f, 0, 0}, {0.7f, 2.1f, 0, 0}, {0, 0, 1, 0}}});
        }) == singular);
  CHECK(message([] { return Transform::scale({1, NAN, 1}); }) == singular);
  CHECK(message([] { return Transform::translate({kInfinity, 0, 0}); }) == singular);
  CHECK(message([] { return Transform::scale({1e-10f, 1e-10f, 1e-10f}); }) == "no error");
  CHECK(message([] { return Transform::scale({1e10f, 1, 1e-10f}); }) == "no error");
  CHECK(message([] {
          return Transform::rotate({0, 0, 0}, 1);
        }) == "the rotation axis has no direction");
  CHECK(message([] {
          return Transform::look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0});
        }) == "look_at: origin and target are the same point");
  CHECK(message([] {
          return Transform::look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0});
        }) == "look_at: up is parallel to the direction from origin to target");
  CHECK(message([] {
          return Transform::look_at({0, 0, 0}, {0, 3, 0}, {0, 0, 0});
        }) == "look_at: up has no direction");
}
