#include "../sample.h"

#include <cmath>

#include <doctest/doctest.h>

#include "../learner.h"
#include "../model.h"
#include "test_paths.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;

TEST_CASE("samples: each triplet once, with all that follows") {
  const std::vector<Sample> samples = samples_of(path_from_sensor());
  REQUIRE(samples.size() == 3);
  // The weight is 2 * 0.5 * (0.25 * 8 + 3).
  CHECK(samples[0].weight == doctest::Approx(5));
  CHECK(samples[0].triplet.mode ==
        Mode{VertexKind::sensor, Event::discrete_transmit, VertexKind::surface});
  CHECK(samples[0].triplet.vertices[0] == Point3{0, 0, 5});
  CHECK(samples[0].triplet.vertices[1] == Point3{0, 0, 1});
  CHECK(samples[0].triplet.vertices[2] == Point3{0, 0, 0});
  CHECK(samples[1].weight == doctest::Approx(2));
  CHECK(samples[1].triplet.mode ==
        Mode{VertexKind::surface, Event::smooth_reflect, VertexKind::environment});
  CHECK(samples[1].triplet.vertices[2] == Point3{0, 100, 0});
  CHECK(samples[2].weight == doctest::Approx(3));
  CHECK(samples[2].triplet.vertices[2] == Point3{3, 0, 1});
}

TEST_CASE("samples: with light paths, weights are those among both ends") {
  SampleRule rule = kRule;
  rule.light_paths = true;
  const std::vector<Sample> samples = samples_of(path_from_sensor(), rule);
  REQUIRE(samples.size() == 3);
  CHECK(samples[0].weight == doctest::Approx(2));  // 2 * 0.5 * (0.25 * 4 + 1)
  CHECK(samples[1].weight == doctest::Approx(1));
  CHECK(samples[2].weight == doctest::Approx(1));
}

TEST_CASE("samples: paths from lights are read as if they came from the sensor") {
  CHECK(samples_of(path_from_light()).empty());
  SampleRule rule = kRule;
  rule.light_paths = true;
  const std::vector<Sample> samples = samples_of(path_from_light(), rule);
  REQUIRE(samples.size() == 3);
  CHECK(samples[0].weight == doctest::Approx(10 * 0.5 * 0.2));
  CHECK(samples[0].triplet.mode ==
        Mode{VertexKind::surface, Event::smooth_reflect, VertexKind::environment});
  CHECK(samples[0].triplet.vertices[0] == Point3{2, 0, 0});
  CHECK(samples[0].triplet.vertices[2] == Point3{1, 100, 0});
  CHECK(samples[1].weight == doctest::Approx(10 * 0.1));
  CHECK(samples[1].triplet.mode ==
        Mode{VertexKind::sensor, Event::smooth_reflect, VertexKind::environment});
  CHECK(samples[2].weight == doctest::Approx(5 * 0.2));
  CHECK(samples[2].triplet.vertices[2] == Point3{1, 0, 0});
}

TEST_CASE("samples: lights that no step can meet are of a kind of their own; nothing of NaN") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .throughput = Rgb(1)});
  log.add(RecordedVertex{.position = {0, 0, 1}, .parent = 0, .throughput = Rgb(1)});
  RecordedLightSample sun{.vertex = 1,
                          .kind = VertexKind::environment,
                          .event = Event::smooth_reflect,
                          .discrete = true,
                          .direction = {0, 1, 0},
                          .contribution = Rgb(3)};
  log.add(sun);
  sun.contribution = Rgb(std::nanf(""));
  log.add(sun);
  const std::vector<Sample> samples = samples_of(log);
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].triplet.mode.after == VertexKind::light);
  CHECK(samples[0].triplet.vertices[2] == Point3{0, 100, 1});
  // The mixture of first vertices uses this sample, the mixtures of next vertices do not.
  const VertexTripletsLearner learner({.cells = 1});
  const auto state = learner.begin({.region = {{-1, -1, -1}, {1, 1, 1}}});
  state->absorb(log);
  const auto model =
      std::dynamic_pointer_cast<const VertexTripletsModel>(state->update({0, 0}).model);
  REQUIRE(model);
  CHECK(model->camera().size() == 1);
  CHECK(model->component_count() == 0);
}

}  // namespace
}  // namespace pharos::vertex_triplets
