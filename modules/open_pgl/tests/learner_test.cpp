#include "../learner.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>

#include "../pgl_field.h"
#include "../sample.h"
#include "test_paths.h"

namespace pharos::open_pgl {
namespace {

using namespace testing;

constexpr Point3 kFloor{0.5f, -0.4f, 0};

TEST_CASE("more is expected from the lamp than from below; nothing outside the scene") {
  const auto model = trained(OpenPglSettings{});
  const Vec3 to_lamp = normalize(kLamp - kFloor);
  CHECK(density(*model, kFloor, to_lamp) > 2 * density(*model, kFloor, {0, 0, -1}));
  CHECK(model->density(kFloor) == 1);
  CHECK(model->density(Point3{50, 0, 0}) == 0);
  CHECK(model->info().bounds.contains(kRegion.low));
}

TEST_CASE("a model stays as it is while learning goes on") {
  const auto state = OpenPglLearner({}).begin({.region = kRegion});
  const auto early = trained(*state, 1);
  const double before = density(*early, kFloor, {0, 0, 1});
  const auto late = trained(*state, 3);
  CHECK(density(*early, kFloor, {0, 0, 1}) == before);
  CHECK(density(*late, kFloor, {0, 0, 1}) != before);
}

TEST_CASE("without samples there is no model") {
  const auto state = OpenPglLearner({}).begin({.region = kRegion});
  CHECK(state->update({0, 1}).model == nullptr);
  state->absorb(lamp_paths(5000, 1));
  CHECK(state->update({1, 1}).model != nullptr);
}

TEST_CASE("the same answers, to the bit, for any number of threads") {
  device();  // made with all threads
  std::string expected;
  for (const std::size_t threads : {1u, 2u, 3u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::string bits = answers(*trained(OpenPglSettings{}));
    if (expected.empty()) expected = bits;
    CHECK(bits == expected);
  }
}

TEST_CASE("saved learning goes on as if it had not been interrupted") {
  for (const int before : {0, 2}) {
    const OpenPglLearner learner({});
    const auto whole = learner.begin({.region = kRegion});
    trained(*whole, before);
    whole->absorb(lamp_paths(500, 77));
    std::istringstream file(saved(*whole));
    const auto resumed = learner.begin({.region = kRegion});
    load(file, *resumed);
    CHECK(answers(*trained(*whole, 2)) == answers(*trained(*resumed, 2)));
  }
}

TEST_CASE("samples that are too many to wait are learned from before the iteration ends") {
  const auto updates = [](std::uint32_t batch_samples) {
    const auto state = OpenPglLearner({.batch_samples = batch_samples}).begin({.region = kRegion});
    for (const std::uint64_t seed : {1u, 2u}) state->absorb(lamp_paths(1500, seed));
    return state->update({0, 0}).model->info().facts.at(0).value;
  };
  CHECK(updates(4096) == "1");
  CHECK(updates(1024) == "2");
}

TEST_CASE("models survive being saved; damaged ones are refused before the library sees them") {
  const std::string file = saved(*trained(OpenPglSettings{}));
  CHECK(saved(*loaded(file)) == file);
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = file;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    if (i % 5 == 0) damaged.resize(random() % damaged.size());
    CHECK_THROWS_AS(loaded(damaged), InputError);
  }
}

TEST_CASE("samples are finite: light of NaN is left out, the sky is far away but not infinitely") {
  const auto samples = [](Rgb light, VertexKind end) {
    PathLog log;
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = {0, 0, 1},
                           .pdf = 0.5f});
    log.add(RecordedVertex{.position = {0, 0, 3}, .kind = end, .parent = 1, .emission = light});
    std::vector<Sample> found;
    PathScratch scratch;
    extract_samples(log[0], {.most_distance = 400}, scratch, found);
    return found;
  };
  const auto lamp = samples(Rgb(3), VertexKind::surface);
  REQUIRE(lamp.size() == 1);
  CHECK(lamp[0].weight == doctest::Approx(6));
  CHECK(lamp[0].distance == 3);
  CHECK(samples(Rgb(1), VertexKind::environment).at(0).distance == 400);
  CHECK(samples(Rgb(0), VertexKind::surface).at(0).weight == 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(samples(Rgb(nan), VertexKind::surface).empty());
}

}  // namespace
}  // namespace pharos::open_pgl
