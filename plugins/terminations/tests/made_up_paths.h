#pragma once

#include <array>

#include <pharos/guiding/record/path_record.h>

namespace pharos::test {

/// Adds a path to a log: lens - wall - light. One step in `branches` from the wall, each weighted
/// by `continuation`, finds the radiance `found` times 1, 2, 3 …; the wall reflects one half. A
/// guide of the camera has chosen the film position with one over `film_weight` times the density
/// of even choice.
inline void add_path(PathLog& log, float found, std::uint32_t branches, float continuation,
                     Point3 wall = {0, 0, 1}, Vec2 film = {0.5f, 0.5f}, float film_weight = 1) {
  log.begin_path(film, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor,
                         .event = Event::smooth_reflect,
                         .throughput = Rgb(1),
                         .local_weight = Rgb(film_weight),
                         .direction = {0, 0, 1},
                         .pdf = 1 / film_weight});
  log.set_techniques(0, std::array{Technique{0, 1}, Technique{1, 1 / film_weight}});
  for (std::uint32_t i = 0; i < branches; ++i) {
    log.add(RecordedVertex{.position = wall,
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .throughput = Rgb(film_weight),
                           .local_weight = Rgb(0.5f * continuation),
                           .direction = {0, 0, -1},
                           .pdf = 1,
                           .continuation = continuation,
                           .branch = i});
  }
  for (std::uint32_t i = 0; i < branches; ++i) {
    log.add(RecordedVertex{.parent = 1 + i,
                           .throughput = Rgb(0.5f * continuation * film_weight),
                           .emission = Rgb(found * static_cast<float>(i + 1))});
  }
}

/// Adds light samples at a vertex of the last path: `copies` of weight `continuation`. Copy i finds
/// the radiance i times `found`, as far as the vertex reflects it.
inline void add_light_samples(PathLog& log, std::uint32_t vertex, std::uint32_t copies,
                              float continuation, float found) {
  log.vertex(vertex).light_samples = log.vertex(vertex).light_copies = copies;
  // Light samples that have found nothing are not recorded.
  for (std::uint32_t copy = 1; copy < copies; ++copy) {
    log.add(
        RecordedLightSample{.vertex = vertex,
                            .copy = static_cast<std::uint16_t>(copy),
                            .continuation = continuation,
                            .contribution = Rgb(continuation * found * static_cast<float>(copy))});
  }
}

/// Adds a path that roulette has ended at the wall.
inline void add_ended_path(PathLog& log) {
  log.begin_path({0.5f, 0.5f}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor,
                         .event = Event::smooth_reflect,
                         .throughput = Rgb(1),
                         .local_weight = Rgb(1),
                         .direction = {0, 0, 1}});
  log.add(RecordedVertex{.position = {0, 0, 1},
                         .guidable = true,
                         .parent = 0,
                         .throughput = Rgb(1),
                         .continuation = 0});
}

}  // namespace pharos::test
