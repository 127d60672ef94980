#pragma once

#include <vector>

#include <pharos/guiding/record/path_record.h>

#include "../sample.h"

namespace pharos::vertex_triplets::testing {

inline const SampleRule kRule{.environment = {100}};

inline std::vector<Sample> samples_of(const PathLog& log, const SampleRule& rule = kRule) {
  std::vector<Sample> samples;
  std::vector<Rgb> incident;
  for (std::size_t i = 0; i < log.size(); ++i) extract_samples(log[i], rule, incident, samples);
  return samples;
}

/// Returns the path lens -> glass -> floor -> environment, with a light sample at the floor.
inline PathLog path_from_sensor() {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.position = {0, 0, 5},
                         .kind = VertexKind::sensor,
                         .throughput = Rgb(1),
                         .direction = {0, 0, -1}});
  log.add(RecordedVertex{.position = {0, 0, 1},
                         .event = Event::discrete_transmit,
                         .parent = 0,
                         .throughput = Rgb(2),
                         .local_weight = Rgb(0.5f),
                         .direction = {0, 0, -1},
                         .emission = Rgb(7)});
  log.add(RecordedVertex{.position = {0, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 1,
                         .throughput = Rgb(1),
                         .local_weight = Rgb(0.25f),
                         .direction = {0, 1, 0}});
  log.add(RecordedVertex{.position = {0, 55, 0},
                         .kind = VertexKind::environment,
                         .parent = 2,
                         .throughput = Rgb(0.25f),
                         .emission = Rgb(8),
                         .joint_emission = Rgb(4)});
  log.add(RecordedLightSample{.vertex = 2,
                              .position = {3, 0, 1},
                              .kind = VertexKind::surface,
                              .event = Event::smooth_reflect,
                              .direction = {1, 0, 0},
                              .contribution = Rgb(3),
                              .joint_contribution = Rgb(1)});
  return log;
}

/// Returns the path environment -> floor -> wall; the lens sees the floor and the wall.
inline PathLog path_from_light() {
  PathLog log;
  log.begin_path({}, Transport::importance);
  log.add(RecordedVertex{.position = {9, 9, 9},
                         .kind = VertexKind::environment,
                         .throughput = Rgb(10),
                         .local_weight = Rgb(1),
                         .direction = {0, -1, 0}});
  log.add(RecordedVertex{.position = {1, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 0,
                         .throughput = Rgb(10),
                         .local_weight = Rgb(0.5f),
                         .direction = {1, 0, 0}});
  log.add(RecordedVertex{.position = {2, 0, 0}, .parent = 1, .throughput = Rgb(5)});
  const auto seen = [&](std::uint32_t vertex, float value) {
    log.add(RecordedLightSample{.vertex = vertex,
                                .position = {0, 0, 5},
                                .kind = VertexKind::sensor,
                                .event = Event::smooth_reflect,
                                .contribution = Rgb(2 * value),
                                .joint_contribution = Rgb(value)});
  };
  seen(1, 0.1f);
  seen(2, 0.2f);
  return log;
}

}  // namespace pharos::vertex_triplets::testing
