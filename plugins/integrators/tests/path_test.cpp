// What can be tested without a scene; renders are tested in tests/integration and tests/contracts.

#include "../path.h"

#include <doctest/doctest.h>

#include "../path_text.h"

namespace pharos {
namespace {

TEST_CASE("MIS weights of all techniques sum to one") {
  for (const MisHeuristic heuristic : {MisHeuristic::balance, MisHeuristic::power}) {
    for (const auto& [a, b] : {std::pair{1.0f, 1.0f}, {0.1f, 30.0f}, {1e25f, 2e25f}}) {
      CHECK(mis_weight(heuristic, a, b) + mis_weight(heuristic, b, a) == doctest::Approx(1));
    }
    CHECK(mis_weight(heuristic, 2, 0) == 1);
  }
  CHECK(mis_weight(MisHeuristic::balance, 1, 3) == doctest::Approx(0.25));
  CHECK(mis_weight(MisHeuristic::power, 1, 3) == doctest::Approx(0.1));
}

TEST_CASE("path offers what guides need, and no guiding unless asked") {
  const PathIntegrator path({});
  CHECK(path.guiding() == nullptr);
  CHECK(path.traits().guided);
  CHECK(path.traits().guided_camera);
  CHECK(path.traits().records.light_samples);
  CHECK_FALSE(path.traits().records.light_paths);
}

TEST_CASE("a path's text tells of every vertex and light sample") {
  PathLog log;
  log.begin_path({1.5f, 2.5f}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .event = Event::smooth_reflect});
  log.add(RecordedVertex{.kind = VertexKind::surface, .event = Event::discrete_transmit});
  log.add(RecordedVertex{.kind = VertexKind::environment, .emission = Rgb(3)});
  log.add(RecordedLightSample{.vertex = 1, .contribution = Rgb(0.5f)});
  const std::string text = path_text(log[0], Rgb(1));
  for (const char* word : {"0 sensor", "1 surface", "2 environment", "discrete transmit",
                           "emission (3, 3, 3)", "light sample", "film (1.5000, 2.5000)"}) {
    CHECK_MESSAGE(text.find(word) != std::string::npos, word);
  }
}

}  // namespace
}  // namespace pharos
