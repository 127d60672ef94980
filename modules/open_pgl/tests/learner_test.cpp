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
  CHECK(model->density(kFloor, normalize(kLamp - kFloor)) > 2 * model->density(kFloor, {0, 0, -1}));
  CHECK(model->density(kFloor) == 1);
  CHECK(model->density(Point3{50, 0, 0}) == 0);
  CHECK(model->bounds().contains(kRegion.low));
}

TEST_CASE("a model stays as it is while learning goes on") {
  const auto state = OpenPglLearner({}).begin({.region = kRegion});
  const auto early = trained(*state, 1);
  const double before = early->density(kFloor, {0, 0, 1});
  const auto late = trained(*state, 3);
  CHECK(early->density(kFloor, {0, 0, 1}) == before);
  CHECK(late->density(kFloor, {0, 0, 1}) != before);
}

TEST_CASE("without samples there is no model") {
  const auto state = OpenPglLearner({}).begin({.region = kRegion});
  CHECK(state->update(0, false) == nullptr);
  state->absorb(lamp_paths(5000, 1));
  CHECK(state->update(1, false) != nullptr);
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
    std::stringstream file;
    whole->save(file);
    const auto resumed = learner.begin({.region = kRegion});
    resumed->load(file);
    CHECK(answers(*trained(*whole, 2)) == answers(*trained(*resumed, 2)));
  }
}

TEST_CASE("merged states know what both absorbed; those of other iterations are refused") {
  const OpenPglLearner learner({});
  const auto whole = learner.begin({.region = kRegion}), part = learner.begin({.region = kRegion}),
             other = learner.begin({.region = kRegion});
  whole->absorb(lamp_paths(3000, 1));
  whole->absorb(lamp_paths(3000, 2));
  part->absorb(lamp_paths(3000, 1));
  other->absorb(lamp_paths(3000, 2));
  part->merge(*other);
  CHECK(answers(*whole->update(0, false)) == answers(*part->update(0, false)));
  CHECK_THROWS_AS(part->merge(*other), InputError);
}

TEST_CASE("states that learned before the iteration's end are not merged") {
  const OpenPglLearner learner({.batch_samples = 1024});
  const auto one = learner.begin({.region = kRegion}), other = learner.begin({.region = kRegion});
  for (auto* state : {one.get(), other.get()}) state->absorb(lamp_paths(1500, 1));
  CHECK_THROWS_AS(one->merge(*other), InputError);
}

TEST_CASE("models survive being saved; damaged ones are refused before the library sees them") {
  const OpenPglLearner learner({});
  const std::string file = saved(*trained(OpenPglSettings{}));
  std::istringstream in(file);
  CHECK(saved(*learner.load_model(in)) == file);
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = file;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    if (i % 5 == 0) damaged.resize(random() % damaged.size());
    std::istringstream stream(damaged);
    CHECK_THROWS_AS(learner.load_model(stream), InputError);
  }
}

TEST_CASE("samples are finite: light of NaN is left out, the sky is far away but not infinitely") {
  const auto samples = [](Rgb light, VertexKind end) {
    PathLog log;
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.event = Event::smooth_reflect,
                           .parent = 0,
                           .local_weight = Rgb(1),
                           .direction = {0, 0, 1},
                           .unguided_pdf = 0.5f,
                           .guidable = true});
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
