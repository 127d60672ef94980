// Compares the tangents of every shape with differences between neighboring hits, in the world and
// in instances.

#include <string>

#include <doctest/doctest.h>

#include "../box.h"
#include "../cylinder.h"
#include "../disk.h"
#include "../heightfield.h"
#include "../lathe.h"
#include "../quad.h"
#include "../sphere.h"
#include "shape_test_kit.h"

namespace pharos {
namespace {

/// A texture of gentle hills.
class Hills final : public Texture {
 public:
  Rgb value_at(const SurfacePoint& point) const override {
    return Rgb(1 + 0.5f * std::sin(5 * point.uv.x) * std::cos(4 * point.uv.y));
  }
  Rgb maximum() const override { return Rgb(1.5f); }
  Rgb average() const override { return Rgb(1); }
};

SceneParts alone(Ref<Shape> shape, Ref<Bsdf> bsdf) {
  SceneParts parts;
  parts.objects.push_back(test::object_of(std::move(shape)));
  parts.objects.back().bsdf = std::move(bsdf);
  return parts;
}

SceneParts placed(Ref<Shape> shape, const Transform& map) {
  SceneParts parts;
  parts.groups.push_back({alone(std::move(shape), std::make_shared<test::BrushedBsdf>()).objects});
  parts.instances.push_back({0, map});
  return parts;
}

Transform even() {
  return Transform::translate({1, -2, 0.5f}) * Transform::rotate({1, 2, 3}, 50) *
         Transform::scale({1.5f, 1.5f, 1.5f});
}
Transform sheared() {
  return Transform({{{1.5f, 0.4f, 0.2f, 0.3f}, {0, 0.8f, -0.3f, 1}, {0.1f, 0.2f, 1.1f, -2}}});
}
Transform mirror() {
  return Transform::scale({1, -1, 1});
}

struct Subject {
  std::string name;
  Ref<Shape> shape;
};

/// Returns every shape, plain, flipped and transformed; round shapes by uniform maps.
std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const bool flip : {false, true}) {
    for (const bool mirrored : {false, true}) {
      const std::string how = std::string(flip ? " flipped" : "") + (mirrored ? " mirrored" : "");
      const Transform round = mirrored ? even() * mirror() : even();
      const Transform any = mirrored ? sheared() * mirror() : sheared();
      const auto add = [&](const std::string& name, Ref<Shape> shape) {
        all.push_back({name + how, std::move(shape)});
      };
      add("sphere", std::make_shared<Sphere>(
                        Sphere::Settings{.radius = 0.8f, .to_world = round, .flip_normals = flip}));
      add("cylinder", std::make_shared<Cylinder>(Cylinder::Settings{.p0 = {0.3f, -0.8f, 0},
                                                                    .p1 = {-0.1f, 0.6f, 0.5f},
                                                                    .radius = 0.7f,
                                                                    .to_world = round,
                                                                    .flip_normals = flip}));
      add("disk", std::make_shared<Disk>(Disk::Settings{.to_world = any, .flip_normals = flip}));
      add("quad", std::make_shared<Quad>(Quad::Settings{.to_world = any, .flip_normals = flip}));
      add("box", std::make_shared<Box>(Box::Settings{.to_world = any, .flip_normals = flip}));
      const std::vector<Vec2> profile{{0.4f, -1}, {0.9f, -0.2f}, {0.5f, 0.9f}};
      for (const bool smooth : {false, true}) {
        add("lathe", std::make_shared<Lathe>(Lathe::Settings{.profile = profile,
                                                             .segments = 400,
                                                             .smooth = smooth,
                                                             .to_world = any,
                                                             .flip_normals = flip}));
        add("heightfield", std::make_shared<Heightfield>(
                               Heightfield::Settings{.texture = std::make_shared<Hills>(),
                                                     .resolution = {201, 201},
                                                     .height = 0.4f,
                                                     .smooth = smooth,
                                                     .to_world = any,
                                                     .flip_normals = flip}));
      }
    }
  }
  return all;
}

void check_frame(const SurfacePoint& p) {
  const Frame& f = p.shading;
  const Vec3 du = p.tangents.du;
  CHECK(length(f.s) == doctest::Approx(1).epsilon(1e-5));
  CHECK(std::abs(dot(f.s, f.n)) < 1e-5f);
  CHECK(length(cross(f.n, f.s) - f.t) < 1e-6f);
  CHECK(dot(f.s, du) > 0.1f * length(du));
  CHECK(std::abs(dot(f.t, du)) < 1e-4f * length(du));
}

/// Compares hits of neighboring rays with the prediction of the tangents.
void check_tangents(const Scene& scene) {
  const Point3 center = scene.bounds().center();
  const float size = scene.bounds().diagonal(), step = 5e-4f * size;
  RandomStream random(3);
  int met = 0;
  for (int i = 0; i < 2500; ++i) {
    const Vec3 side = test::random_direction(random);
    const Point3 target = center + 0.2f * size * test::random_direction(random);
    const Vec3 direction = normalize(target - (center + size * side));
    const Point3 origin = center + size * side;
    const Vec3 across = step * normalize(cross(direction, test::random_direction(random)));
    SurfacePoint p, q;
    const bool both = scene.intersect({origin, direction}, p) < kInfinity &&
                      scene.intersect({origin + across, direction}, q) < kInfinity;
    if (!both || p.primitive != q.primitive || abs_dot(p.normal, direction) < 0.2f) continue;
    if (dot(p.normal, q.normal) < 0.99f) continue;
    const Vec2 change = q.uv - p.uv;
    if (std::abs(change.x) > 0.01f) continue;  // across the seam, or near a pole
    ++met;
    check_frame(p);
    const Vec3 moved = q.position - p.position;
    const Vec3 foretold = 0.5f * change.x * (p.tangents.du + q.tangents.du) +
                          0.5f * change.y * (p.tangents.dv + q.tangents.dv);
    CHECK(length(moved - foretold) < 0.02f * length(moved) + 2 * p.error);
  }
  CHECK(met > 20);
}

TEST_CASE("tangents are how positions move with texture coordinates, on every shape") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    check_tangents(Scene(alone(subject.shape, std::make_shared<test::BrushedBsdf>())));
  }
}

TEST_CASE("tangents of instances are mapped with them, mirrored and sheared ones too") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    check_tangents(Scene(placed(subject.shape, sheared())));
    check_tangents(Scene(placed(subject.shape, even() * mirror())));
  }
}

TEST_CASE("tangents are left out where no material asks for them") {
  for (const Subject& subject : subjects()) {
    const Scene scene(alone(subject.shape, std::make_shared<test::BlackBsdf>()));
    const Point3 center = scene.bounds().center();
    RandomStream random(4);
    for (int i = 0; i < 50; ++i) {
      const Vec3 d = test::random_direction(random);
      SurfacePoint p;
      if (scene.intersect({center - 3 * scene.bounds().diagonal() * d, d}, p) == kInfinity)
        continue;
      CHECK(p.tangents.du == Vec3{});
      CHECK(p.tangents.dv == Vec3{});
      CHECK(p.shading.s == Frame::from_normal(p.shading.n).s);
    }
  }
}

TEST_CASE("a sphere has no tangent at its poles, and a frame all the same") {
  const Scene scene(
      alone(std::make_shared<Sphere>(Sphere::Settings{}), std::make_shared<test::BrushedBsdf>()));
  SurfacePoint p;
  REQUIRE(scene.intersect({{0, 0, 5}, {0, 0, -1}}, p) < kInfinity);
  CHECK(p.tangents.du == Vec3{});
  CHECK(length(cross(p.shading.s, p.shading.t) - p.shading.n) < 1e-6f);
}

}  // namespace
}  // namespace pharos
