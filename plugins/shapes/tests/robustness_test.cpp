// Rays that leave a closed surface must neither hit it again at once nor slip through it, at any
// scale and at any distance from the origin.

#include <doctest/doctest.h>

#include "../box.h"
#include "../cylinder.h"
#include "../disk.h"
#include "../lathe.h"
#include "../sphere.h"
#include "shape_test_kit.h"

namespace pharos {
namespace {

constexpr int kSteps = 50'000;

struct Placement {
  float scale;
  Vec3 offset;  ///< in units of `scale`
  bool turned;
};

std::vector<Placement> placements() {
  std::vector<Placement> all;
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {
    for (const Vec3 offset : {Vec3{0, 0, 0}, Vec3{200, -190, 210}}) {
      for (const bool turned : {false, true}) all.push_back({scale, offset, turned});
    }
  }
  return all;
}

Transform to_world(const Placement& p) {
  const Transform scaled = Transform::scale({p.scale, p.scale, p.scale});
  const Transform turned = p.turned ? Transform::rotate({1, 2, 3}, 40) * scaled : scaled;
  return Transform::translate(p.scale * p.offset) * turned;
}

struct Faults {
  int leaks = 0;         ///< rays inside that hit nothing
  int self_hits = 0;     ///< rays inside that hit the face they left
  int outer_hits = 0;    ///< rays outside that hit the convex shape they left
  int blocked_self = 0;  ///< self hits that occlusion queries report
};

/// Walks from wall to wall inside a convex shape. At each step it also sends a ray from the outer
/// side.
template <class IsSelfHit>
Faults walk(const Scene& scene, Point3 start, const IsSelfHit& is_self_hit) {
  Faults faults;
  RandomStream random(7);
  Ray ray{start, test::random_direction(random)};
  for (int i = 0; i < kSteps; ++i) {
    SurfacePoint hit;
    if (scene.intersect(ray, hit) == kInfinity) {
      ++faults.leaks;
      ray = {start, test::random_direction(random)};
      continue;
    }
    const Vec3 outwards = test::random_departure(hit.normal, random);
    const Ray outer{hit.origin_towards(outwards), outwards};
    SurfacePoint other;
    if (scene.intersect(outer, other) < kInfinity) ++faults.outer_hits;
    if (scene.occluded(outer)) ++faults.blocked_self;

    const Vec3 inwards = test::random_departure(-hit.normal, random);
    ray = {hit.origin_towards(inwards), inwards};
    const float t = scene.intersect(ray, other);
    if (t < kInfinity && is_self_hit(hit, other, inwards, t)) ++faults.self_hits;
  }
  return faults;
}

void check(const Faults& faults, const Placement& p) {
  INFO("scale ", p.scale, ", offset ", p.offset.x, ", turned ", p.turned);
  CHECK(faults.leaks == 0);
  CHECK(faults.self_hits == 0);
  CHECK(faults.outer_hits == 0);
  CHECK(faults.blocked_self == 0);
}

TEST_CASE("no ray leaks out of a box or meets the face it leaves") {
  for (const Placement& p : placements()) {
    const auto scene = test::scene_of<Box>({.to_world = to_world(p)});
    const auto same_face = [](const SurfacePoint& a, const SurfacePoint& b, Vec3, float) {
      return a.primitive / 2 == b.primitive / 2;
    };
    check(walk(*scene, to_world(p).point({}), same_face), p);
  }
}

TEST_CASE("no ray leaks out of a sphere or meets the point it leaves") {
  for (const Placement& p : placements()) {
    Sphere::Settings settings;
    settings.to_world = to_world(p);
    const auto scene = test::scene_of<Sphere>(settings);
    // A chord from the surface has length 2 r cos. The step inwards moves its start by `error`.
    const auto wrong_chord = [&](const SurfacePoint& a, const SurfacePoint&, Vec3 d, float t) {
      const float chord = 2 * p.scale * abs_dot(a.normal, d);
      return std::abs(t - chord) > 1e-4f * p.scale + 40 * std::sqrt(a.error * p.scale);
    };
    check(walk(*scene, to_world(p).point({}), wrong_chord), p);
  }
}

TEST_CASE("no ray leaks out of a closed lathe or meets the facet it leaves") {
  const std::vector<Vec2> goblet{{0, -1}, {0.6f, -0.8f}, {0.9f, 0}, {0.6f, 0.7f}, {0, 0.9f}};
  for (const Placement& p : placements()) {
    const auto scene =
        test::scene_of<Lathe>({.profile = goblet, .segments = 13, .to_world = to_world(p)});
    const auto same_facet = [](const SurfacePoint& a, const SurfacePoint& b, Vec3, float) {
      return a.primitive == b.primitive;
    };
    check(walk(*scene, to_world(p).point({}), same_facet), p);
  }
}

/// Builds a tube with a disk at each end.
std::unique_ptr<const Scene> closed_tube(const Placement& p) {
  SceneParts parts;
  const Cylinder::Settings tube{.to_world = to_world(p)};
  parts.objects.push_back(test::object_of(std::make_shared<const Cylinder>(tube)));
  for (const float z : {-1.0f, 1.0f}) {
    const Transform lid = Transform::translate({0, 0, z}) * Transform::scale({1, 1, z});
    const Disk::Settings disk{.to_world = to_world(p) * lid};
    parts.objects.push_back(test::object_of(std::make_shared<const Disk>(disk)));
  }
  return std::make_unique<const Scene>(std::move(parts));
}

TEST_CASE("no ray leaks out of a tube with lids or meets the surface it leaves") {
  for (const Placement& p : placements()) {
    // Far from the origin, rounding separates tube and lids by more than the walk could tolerate.
    if (p.offset != Vec3{}) continue;
    const auto scene = closed_tube(p);
    const auto self_hit = [](const SurfacePoint& a, const SurfacePoint& b, Vec3, float t) {
      return a.object == b.object && (a.object != 0 || t < 40 * a.error);
    };
    check(walk(*scene, {}, self_hit), p);
  }
}

/// Sends rays from samples of a shape, on both sides, and counts the rays that hit it at once.
template <class IsSelfHit>
int self_hits(const Scene& scene, const IsSelfHit& is_self_hit) {
  int count = 0;
  RandomStream random(9);
  for (int i = 0; i < kSteps; ++i) {
    SurfacePoint a = scene.objects()[0].shape->sample(random.next_2d()).point, b;
    const Vec3 side = i % 2 == 0 ? a.normal : -a.normal;
    const Vec3 direction = test::random_departure(side, random);
    const float t = scene.intersect({a.origin_towards(direction), direction}, b);
    if (t < kInfinity && is_self_hit(a, direction, t)) ++count;
  }
  return count;
}

TEST_CASE("samples of disks and tubes do not meet their own surface") {
  for (const Placement& p : placements()) {
    INFO("scale ", p.scale, ", offset ", p.offset.x, ", turned ", p.turned);
    const Transform map = to_world(p) * Transform::scale({1, 0.3f, -2});
    const auto disk = test::scene_of<Disk>({.to_world = map});
    CHECK(self_hits(*disk, [](const SurfacePoint&, Vec3, float) { return true; }) == 0);
    const auto tube = test::scene_of<Cylinder>({.to_world = to_world(p)});
    const Vec3 axis = normalize(to_world(p).vector({0, 0, 1}));
    // Inside, a chord has length 2 r cos in projection along the axis.
    const auto wrong_chord = [&](const SurfacePoint& a, Vec3 d, float t) {
      const float across = std::sqrt(std::max(0.0f, 1 - square(dot(d, axis))));
      const float chord = 2 * p.scale * -dot(a.normal, d) / across;
      return chord < 0 ||
             std::abs(t * across - chord) > 1e-4f * p.scale + 40 * std::sqrt(a.error * p.scale);
    };
    CHECK(self_hits(*tube, wrong_chord) == 0);
  }
}

}  // namespace
}  // namespace pharos
