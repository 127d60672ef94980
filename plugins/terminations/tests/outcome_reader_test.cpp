#include "../outcome_reader.h"

#include <limits>

#include <doctest/doctest.h>

#include "made_up_paths.h"

namespace pharos {
namespace {

/// Everything that is read from a log.
struct Outcomes {
  explicit Outcomes(const PathLog& log,
                    TerminationRule::Stage stage = TerminationRule::Stage::vertex,
                    double limit = std::numeric_limits<double>::infinity()) {
    OutcomeReader reader;
    for (std::size_t i = 0; i < log.size(); ++i) {
      paths.push_back(reader.read(log[i], stage, limit, all));
    }
    for (const Outcome& outcome : all) (outcome.of_light ? lights : steps).push_back(outcome);
  }
  std::vector<PathOutcome> paths;
  std::vector<Outcome> all, steps, lights;
};

}  // namespace

TEST_CASE("outcomes: a plain step finds the radiance that its vertex reflects") {
  PathLog log;
  test::add_path(log, 8, 1, 1);
  const Outcomes found(log);
  REQUIRE(found.steps.size() == 1);
  CHECK(found.steps[0].origin == Point3{0, 0, 1});
  CHECK(found.steps[0].towards_viewer == Vec3{0, 0, -1});
  CHECK(found.steps[0].radiance == doctest::Approx(4));
  CHECK(found.steps[0].cost == 1);
  CHECK(found.paths[0].radiance == doctest::Approx(4));
  CHECK(found.paths[0].cost == 2);
}

TEST_CASE("outcomes: each branch of a vertex counts by what it found alone") {
  PathLog log;
  test::add_path(log, 8, 3, 1.0f / 3);
  const Outcomes found(log);
  REQUIRE(found.steps.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(found.steps[i].radiance == doctest::Approx(4 * (i + 1)));
  CHECK(found.paths[0].radiance == doctest::Approx((4 + 8 + 12) / 3.0));
  CHECK(found.paths[0].cost == 4);
}

TEST_CASE(
    "outcomes: a survivor of roulette counts by what it found, paths that ended do not count") {
  PathLog log;
  test::add_path(log, 8, 1, 4);
  for (int i = 0; i < 3; ++i) test::add_ended_path(log);
  const Outcomes found(log);
  REQUIRE(found.steps.size() == 1);
  CHECK(found.steps[0].radiance == doctest::Approx(4));
  CHECK(found.paths[0].radiance == doctest::Approx(16));
  CHECK(found.paths[3].radiance == 0);
  CHECK(found.paths[3].cost == 1);
}

TEST_CASE("outcomes: survivors count for others only if roulette has seen their step") {
  PathLog log;
  test::add_path(log, 8, 1, 4);
  for (int i = 0; i < 3; ++i) test::add_ended_path(log);
  for (const auto stage : {TerminationRule::Stage::vertex, TerminationRule::Stage::step}) {
    const Outcomes found(log, stage);
    REQUIRE(found.steps.size() == 1);
    CHECK(found.steps[0].radiance == doctest::Approx(4));
    CHECK(found.steps[0].count == (stage == TerminationRule::Stage::step ? 4 : 1));
  }
}

TEST_CASE("outcomes: steps and light samples find apart from each other, and paths pay for both") {
  PathLog log;
  test::add_path(log, 8, 3, 0.5f);
  test::add_light_samples(log, 1, 4, 0.25f, 10);
  const Outcomes found(log);
  REQUIRE(found.steps.size() == 3);
  REQUIRE(found.lights.size() == 4);
  for (int i = 0; i < 3; ++i) {
    CHECK(found.steps[i].radiance == doctest::Approx(4 * (i + 1)));
    CHECK(found.steps[i].cost == 1);
  }
  for (int i = 0; i < 4; ++i) {
    CHECK(found.lights[i].radiance == doctest::Approx(10 * i));
    CHECK(found.lights[i].cost == 1);
    CHECK(found.lights[i].origin == Point3{0, 0, 1});
    CHECK(found.lights[i].towards_viewer == Vec3{0, 0, -1});
  }
  CHECK(found.paths[0].cost == 1 + 3 + 4);
  CHECK(found.paths[0].radiance == doctest::Approx(0.5 * (4 + 8 + 12) + 0.25 * (10 + 20 + 30)));
}

TEST_CASE("outcomes: a sample of each light makes one light sample") {
  PathLog log;
  test::add_path(log, 8, 1, 1);
  test::add_light_samples(log, 1, 2, 0.5f, 10);
  test::add_light_samples(log, 1, 2, 0.5f, 100);  // of another light
  log.vertex(1).light_samples = 4;
  const Outcomes found(log);
  REQUIRE(found.lights.size() == 2);
  CHECK(found.lights[0].radiance == 0);
  CHECK(found.lights[1].radiance == doctest::Approx(110));
  for (const Outcome& light : found.lights) CHECK(light.cost == 2);
}

TEST_CASE("outcomes: light samples count where roulette has ended the path, too") {
  PathLog log;
  test::add_ended_path(log);
  test::add_light_samples(log, 1, 2, 0.5f, 10);
  const Outcomes found(log, TerminationRule::Stage::step);
  CHECK(found.steps.empty());
  REQUIRE(found.lights.size() == 2);
  CHECK(found.lights[1].radiance == doctest::Approx(10));
  CHECK(found.lights[1].count == 1);
}

TEST_CASE("outcomes: the limited estimate of a step depends on what it adds to its pixel") {
  PathLog log;
  test::add_path(log, 8, 3, 0.5f);
  log.vertex(1).throughput = log.vertex(2).throughput = log.vertex(3).throughput = Rgb(0.5f);
  const Outcomes found(log, TerminationRule::Stage::vertex, 3);
  REQUIRE(found.steps.size() == 3);
  for (int i = 0; i < 3; ++i) {
    CHECK(found.steps[i].radiance == doctest::Approx(4 * (i + 1)));
    CHECK(found.steps[i].limited == doctest::Approx(i == 0 ? 4 : 6));
  }
  CHECK(found.paths[0].radiance == doctest::Approx(0.5 * (4 + 8 + 12)));
}

TEST_CASE("outcomes: a step costs what all later vertices cost") {
  PathLog log;
  test::add_path(log, 8, 1, 1);
  log.vertex(2).light_samples = 5;
  CHECK(Outcomes(log).steps[0].cost == 1 + 5);
}

TEST_CASE("outcomes: mirrors teach nothing") {
  PathLog log;
  test::add_path(log, 8, 1, 1);
  test::add_light_samples(log, 1, 2, 0.5f, 10);
  log.vertex(1).guidable = false;
  CHECK(Outcomes(log).all.empty());
  CHECK(Outcomes(log).paths[0].radiance == doctest::Approx(4 + 5));
}

}  // namespace pharos
