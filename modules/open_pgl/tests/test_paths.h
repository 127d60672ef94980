#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../learner.h"

namespace pharos::open_pgl::testing {

using test::saved;

inline constexpr Bounds3 kRegion{{-2, -2, -1}, {2, 2, 3}};
inline constexpr Point3 kLamp{0, 0, 2};

/// Returns paths with one guidable step each. The steps start at random points of a floor. Every
/// third one hits a lamp above the floor, the others hit dark walls.
inline PathLog lamp_paths(int count, std::uint64_t seed) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    const Point3 from{2 * u.x - 1, 2 * u.y - 1, 0};
    const bool hits = i % 3 == 0;
    Vec3 aside = warp::sphere_from_square(random.next_2d());
    aside.z = std::abs(aside.z);
    const Point3 to = hits ? kLamp + 0.1f * aside : from + 2 * aside;
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = from,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = normalize(to - from),
                           .pdf = hits ? 20.0f : 0.1f});
    log.add(RecordedVertex{.position = to, .parent = 1, .emission = Rgb(hits ? 5.0f : 0.0f)});
  }
  return log;
}

inline std::shared_ptr<const GuidingModel> trained(LearningState& state,
                                                   std::uint32_t iterations = 3) {
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < iterations; ++i) {
    state.absorb(lamp_paths(5000, i));
    model = state.update({i, iterations - 1 - i}).model;
  }
  return model;
}

inline std::shared_ptr<const GuidingModel> trained(const OpenPglSettings& settings) {
  return trained(*OpenPglLearner(settings).begin({.region = kRegion}));
}

/// Returns the density that a model expects from a direction at a point.
inline double density(const GuidingModel& model, Point3 at, Vec3 direction) {
  return model.density(at, &direction);
}

/// Returns a model's densities at random points and directions as text. The bytes of a field's file
/// cannot be compared, because they also contain times.
inline std::string answers(const GuidingModel& model) {
  std::ostringstream out;
  RandomStream random(11);
  for (int i = 0; i < 200; ++i) {
    const Vec2 u = random.next_2d();
    const Point3 at{2 * u.x - 1, 2 * u.y - 1, 0};
    const Vec3 w = warp::sphere_from_square(random.next_2d());
    out << std::hexfloat << density(model, at, w) << ' ';
  }
  return out.str();
}

/// Returns the model with this saved form.
inline std::shared_ptr<GuidingModel> loaded(const std::string& bytes) {
  std::istringstream in(bytes);
  const auto model = OpenPglLearner({}).empty_model();
  load(in, *model);
  return model;
}

}  // namespace pharos::open_pgl::testing
