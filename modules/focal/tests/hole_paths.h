#pragma once

#include <array>
#include <memory>
#include <span>

#include <pharos/core/random.h>

#include "../learner.h"
#include "../model.h"
#include "test_trees.h"

namespace pharos::focal::testing {

/// Half of the width of the hole through which all light passes, and the hole's center.
inline constexpr float kHole = 0.01f;
inline constexpr Point3 kCenter{0.1f, 1.1f, 3.9f};

/// Returns a random point on the canvas of the camera obscura.
inline Point3 point_on_canvas(RandomStream& random) {
  Point3 p = point_in_box(random, test_box());
  p.z = 2;
  return p;
}

/// Adds paths of one guidable step each, from random points through the hole, as a camera obscura
/// has them; every coordinate times `scale`. `side` limits them to points whose x has its sign.
inline void add_hole_paths(PathLog& log, int count, std::uint64_t seed, float scale = 1,
                           Point3 center = kCenter, float unguided_share = 0.5f, float light = 1,
                           float side = 0) {
  const std::array techniques{Technique{unguided_share, 0.3f}, Technique{1 - unguided_share, 0.3f}};
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Point3 from = point_on_canvas(random);
    if (from.x * side < 0) continue;
    const Vec3 direction = normalize(point_near(random, center, kHole) - from);
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = scale * from,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(1),
                           .direction = direction,
                           .pdf = 0.3f});
    log.set_techniques(1, std::span(techniques).first(unguided_share < 1 ? 2 : 1));
    log.add(RecordedVertex{
        .position = scale * (from + 4.0f * direction), .parent = 1, .emission = Rgb(light)});
  }
}

inline PathLog hole_paths(int count, std::uint64_t seed, float scale = 1, Point3 center = kCenter,
                          float unguided_share = 0.5f) {
  PathLog log;
  add_hole_paths(log, count, seed, scale, center, unguided_share);
  return log;
}

inline LearningContext context(float scale = 1) {
  const Box box = test_box();
  Bounds3 region;
  for (const unsigned corner : {0u, 7u}) {
    Point3 p;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double far = (corner >> axis & 1) != 0 ? box.size[axis] : 0;
      p[static_cast<int>(axis)] = scale * static_cast<float>(box.low[axis] + far);
    }
    region.add(p);
  }
  return {region, 1};
}

/// Trains on `hole_paths` for all iterations.
inline std::shared_ptr<const FocalModel> trained(const FocalSettings& settings, float scale = 1,
                                                 Point3 center = kCenter,
                                                 std::uint32_t iterations = 10) {
  const auto state = FocalLearner(settings).begin(context(scale));
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < iterations; ++i) {
    for (std::uint64_t unit = 0; unit < 3; ++unit) {
      state->absorb(hole_paths(1000, 10 * i + unit, scale, center));
    }
    model = state->update({i, iterations - 1 - i}).model;
  }
  return std::dynamic_pointer_cast<const FocalModel>(model);
}

/// Returns the share of sampled directions from the canvas that pass through the hole.
inline double hits(const FocalModel& model, Point3 center = kCenter) {
  RandomStream random(99);
  constexpr int kDraws = 10'000;
  int through = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Point3 from = point_on_canvas(random);
    const float sign = random.next_1d();
    const Vec2 u = random.next_2d();
    const auto w = model.focal_density().sample_direction(from, sign, {u.x, u.y, random.next_1d()});
    if (!w || w->z <= 0) continue;
    const Point3 p = from + (center.z - from.z) / w->z * *w;
    through += max_component(abs(p - center)) < kHole ? 1 : 0;
  }
  return static_cast<double>(through) / kDraws;
}

}  // namespace pharos::focal::testing
