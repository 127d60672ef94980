#pragma once

#include <memory>

#include <pharos/core/random.h>

#include "../learner.h"
#include "../model.h"
#include "test_next_vertices.h"

namespace pharos::vertex_triplets::testing {

/// Adds paths over a mirror-like floor under a lens. Light reaches a point of the floor from the
/// mirrored direction of the lens. It is never inlined, because copies in different places may
/// round in different ways.
[[gnu::noinline]] inline void add_mirror_paths(PathLog& log, int count, std::uint64_t seed,
                                               float light = 1) {
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d(), v = random.next_2d();
    const Point3 lens{v.x, v.y, 1}, floor{2 * u.x - 0.5f, 2 * u.y - 0.5f, 0};
    const Vec3 in = floor - lens;
    const Point3 ceiling = floor + Vec3{in.x, in.y, 1} + 0.02f * Vec3{random.next_1d(), 0, 0};
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.position = lens, .kind = VertexKind::sensor, .throughput = Rgb(1)});
    log.add(RecordedVertex{.position = floor,
                           .event = Event::smooth_reflect,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(1),
                           .direction = normalize(ceiling - floor)});
    log.add(RecordedVertex{
        .position = ceiling, .parent = 1, .emission = Rgb(light), .joint_emission = Rgb(light)});
  }
}

inline PathLog mirror_paths(int count, std::uint64_t seed) {
  PathLog log;
  add_mirror_paths(log, count, seed);
  return log;
}

inline LearningContext context() {
  Bounds3 region;
  region.add(Point3{-1.5f, -1.5f, 0});
  region.add(Point3{2.5f, 2.5f, 1});
  return {.region = region, .seed = 7};
}

inline std::shared_ptr<const VertexTripletsModel> learned(const VertexTripletsSettings& settings,
                                                          std::uint32_t updates = 3) {
  const auto state = VertexTripletsLearner(settings).begin(context());
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < updates; ++i) {
    state->absorb(mirror_paths(2000 << i, 20 + i));
    model = state->update({i, updates - 1 - i}).model;
  }
  return std::dynamic_pointer_cast<const VertexTripletsModel>(model);
}

/// Returns the mean distance between the point on the ceiling from which light comes and the means
/// that the model predicts. Queries without an answer have the error `unanswered`.
inline double mirror_error(const VertexTripletsModel& model, double unanswered = 0) {
  class Flat final : public PhaseFunction {
   public:
    float evaluate(Vec3, Vec3) const override { return 1; }
    Vec3 sample(Vec3 wo, Vec2) const override { return wo; }
    float mean_cosine() const override { return 0; }
  } flat;
  RandomStream random(99);
  double sum = 0;
  int answers = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec2 u = random.next_2d(), v = random.next_2d();
    const Point3 lens{v.x, v.y, 1}, floor{2 * u.x - 0.5f, 2 * u.y - 0.5f, 0};
    const GuidingVertex previous{.position = lens, .kind = VertexKind::sensor};
    const GuidingVertex current{.position = floor};
    const Vec3 back = normalize(lens - floor);
    const LocalScattering scattering(flat, Rgb(1), back, Transport::radiance);
    const GuidingQuery query{.previous = &previous,
                             .current = current,
                             .towards_previous = back,
                             .scattering = &scattering,
                             .region = model.place(current).region};
    Arena arena;
    const Vec3 in = floor - lens;
    const auto vertices =
        vertices_of(model.next_vertices(query, mask_of(Event::smooth_reflect), arena));
    if (vertices.empty()) sum += unanswered;
    for (const NextVertex& next : vertices) {
      const Point3 ceiling = floor + Vec3{in.x, in.y, 1};
      sum += next.gaussian.weight * length(next.gaussian.mean - ceiling);
      answers += 1;
    }
  }
  return answers > 0 ? sum / 300 : 1e9;
}

}  // namespace pharos::vertex_triplets::testing
