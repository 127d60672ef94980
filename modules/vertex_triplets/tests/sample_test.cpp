#include "../sample.h"

#include <array>
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

TEST_CASE("samples: without light samples the light still counts in steps to its vertex") {
  SampleRule rule = kRule;
  rule.light_samples = false;
  const std::vector<Sample> samples = samples_of(path_from_sensor(), rule);
  REQUIRE(samples.size() == 2);
  CHECK(samples[0].weight == doctest::Approx(5));  // 2 * 0.5 * (0.25 * 8 + 3)
  CHECK(samples[1].weight == doctest::Approx(2));
  CHECK(samples[1].triplet.mode.after == VertexKind::environment);
  // Without their connections to the lens, paths from lights would teach nothing.
  rule.light_paths = true;
  CHECK(samples_of(path_from_light(), rule).size() == 3);
}

/// Returns the path lens -> floor -> wall -> lamp of radiance 8, with a light sample at the wall.
/// The throughputs at floor and wall are 3 and 1.5.
PathLog path_over_two_surfaces() {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .throughput = Rgb(1)});
  log.add(RecordedVertex{.position = {1, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 0,
                         .throughput = Rgb(3),
                         .local_weight = Rgb(0.5f)});
  log.add(RecordedVertex{.position = {2, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 1,
                         .throughput = Rgb(1.5f),
                         .local_weight = Rgb(0.4f)});
  log.add(RecordedVertex{
      .position = {3, 0, 0}, .parent = 2, .throughput = Rgb(0.6f), .emission = Rgb(8)});
  log.add(RecordedLightSample{.vertex = 2,
                              .position = {3, 1, 0},
                              .kind = VertexKind::surface,
                              .event = Event::smooth_reflect,
                              .contribution = Rgb(2)});
  return log;
}

TEST_CASE("samples: weights of suffixes are without the throughput, except at first vertices") {
  const auto weights = [](bool suffixes) {
    SampleRule rule = kRule;
    rule.suffixes = suffixes;
    std::vector<float> result;
    for (const Sample& s : samples_of(path_over_two_surfaces(), rule)) result.push_back(s.weight);
    REQUIRE(result.size() == 3);
    return result;
  };
  const std::vector<float> paths = weights(false), suffixes = weights(true);
  CHECK(paths[0] == doctest::Approx(3 * 0.5 * (0.4 * 8 + 2)));
  CHECK(suffixes[0] == paths[0]);
  CHECK(paths[1] == doctest::Approx(1.5 * 0.4 * 8));
  CHECK(suffixes[1] == doctest::Approx(0.4 * 8));
  CHECK(paths[2] == doctest::Approx(1.5 * 2));
  CHECK(suffixes[2] == doctest::Approx(2));
}

/// Returns the path lens -> wall -> floor -> two lamps of radiance 8 and 2. It splits at the floor,
/// whose branches have the factor `continuation`. The throughput at the floor is 1.5.
PathLog path_with_branches(float continuation) {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .throughput = Rgb(1)});
  log.add(RecordedVertex{.position = {1, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 0,
                         .throughput = Rgb(3),
                         .local_weight = Rgb(0.5f)});
  for (const std::uint32_t branch : {0u, 1u}) {
    log.add(RecordedVertex{.position = {2, 0, 0},
                           .event = Event::smooth_reflect,
                           .parent = 1,
                           .throughput = Rgb(1.5f),
                           .local_weight = Rgb(0.4f * continuation),
                           .continuation = continuation,
                           .branch = branch});
  }
  for (const std::uint32_t floor : {2u, 3u}) {
    log.add(RecordedVertex{.position = {3, static_cast<float>(floor), 0},
                           .parent = floor,
                           .emission = Rgb(floor == 2 ? 8.0f : 2.0f)});
  }
  return log;
}

TEST_CASE("samples: branches of a vertex weigh as much as one step together") {
  for (const bool suffixes : {false, true}) {
    CAPTURE(suffixes);
    SampleRule rule = kRule;
    rule.suffixes = suffixes;
    const std::vector<Sample> samples = samples_of(path_with_branches(0.5f), rule);
    REQUIRE(samples.size() == 3);
    const double prefix = suffixes ? 1 : 1.5;
    // The step to the floor counts once, with the mean of the branches. A whole branch weighs
    // 0.4 times its lamp.
    CHECK(samples[0].weight == doctest::Approx(3 * 0.5 * 0.4 * (8 + 2) / 2));
    CHECK(samples[1].weight == doctest::Approx(prefix * 0.4 * 8 / 2));
    CHECK(samples[2].weight == doctest::Approx(prefix * 0.4 * 2 / 2));
    CHECK(samples[2].triplet.vertices[2] == Point3{3, 3, 0});
  }
}

/// Adds a path to a pixel in the row y = 0. It is lit by `light` after an event. `even` is the
/// density of an even choice of pixels over the density with which this pixel was chosen.
void add_path(PathLog& log, float x, Event event, float light, float even) {
  log.begin_path({x, 0.5f}, Transport::radiance);
  log.add(RecordedVertex{.position = {0, 0, 1},
                         .kind = VertexKind::sensor,
                         .throughput = Rgb(1),
                         .local_weight = Rgb(1),
                         .pdf = 2});
  log.set_techniques(0, std::array{Technique{.share = 1, .density = 2 * even}});
  log.add(RecordedVertex{.event = event,
                         .parent = 0,
                         .throughput = Rgb(1),
                         .local_weight = Rgb(1),
                         .direction = {0, 0, 1}});
  log.add(RecordedVertex{.position = {0, 0, 1}, .parent = 1, .emission = Rgb(even * light)});
}

/// Returns the share of reflection after two iterations over two pixels: one of value 9, which
/// shows reflected light and is chosen twice as often, and one of value 1, which shows
/// transmitted light.
double share_of_reflection(SampleWeights weights, int pixel_radius, double least_pixel) {
  const VertexTripletsLearner learner(
      {.cells = 1, .weights = weights, .pixel_radius = pixel_radius, .least_pixel = least_pixel});
  const auto state = learner.begin({.region = {{-1, -1, -1}, {1, 1, 1}}, .window = {0, 0, 2, 1}});
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < 2; ++i) {
    PathLog log;
    for (int k = 0; k < 2; ++k) add_path(log, 0.5f, Event::smooth_reflect, 9, 0.5f);
    add_path(log, 1.5f, Event::smooth_transmit, 1, 1);
    state->absorb(log);
    model = state->update({i, 1 - i}).model;
  }
  double share = 0;
  for (const auto& run :
       std::dynamic_pointer_cast<const VertexTripletsModel>(model)->knowledge(0).triplets) {
    if (run.mode.event != Event::smooth_reflect) continue;
    for (const auto& component : run.components) share += component.weight;
  }
  return share;
}

TEST_CASE("samples: relative weights are those over the pixel's value, from the first update on") {
  CHECK(share_of_reflection(SampleWeights::path, 0, 1e-6) == doctest::Approx(0.9));
  // The mean of the image is 5, so both pixels have the weight 5 in the second iteration.
  CHECK(share_of_reflection(SampleWeights::relative, 0, 1e-6) ==
        doctest::Approx((9 + 5) / (10.0 + 10)));
  // Blurred, both pixels have the value 5.
  CHECK(share_of_reflection(SampleWeights::relative, 1, 1e-6) == doctest::Approx(0.9));
  // The dark pixel counts as if it had half of the mean.
  CHECK(share_of_reflection(SampleWeights::relative, 0, 0.5) ==
        doctest::Approx((9 + 5) / (10.0 + 5 + 2)));
}

}  // namespace
}  // namespace pharos::vertex_triplets
