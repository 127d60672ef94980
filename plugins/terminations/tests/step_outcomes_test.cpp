#include "../step_outcomes.h"

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
      paths.push_back(reader.read(log[i], stage, limit, steps));
    }
  }
  std::vector<PathOutcome> paths;
  std::vector<StepOutcome> steps;
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
    CHECK(found.steps[0].steps == (stage == TerminationRule::Stage::step ? 4 : 1));
  }
}

TEST_CASE("outcomes: each step has found what its own light sample has found, and pays for it") {
  PathLog log;
  test::add_path(log, 8, 3, 0.5f);
  log.vertex(1).light_samples = 3;
  // The light sample of the first step has found nothing.
  for (const std::uint16_t copy : {1, 2}) {
    log.add(RecordedLightSample{
        .vertex = 1, .copy = copy, .continuation = 0.5f, .contribution = Rgb(0.5f * 10 * copy)});
  }
  const Outcomes found(log);
  REQUIRE(found.steps.size() == 3);
  for (int i = 0; i < 3; ++i) {
    CHECK(found.steps[i].radiance == doctest::Approx(4 * (i + 1) + 10 * i));
    CHECK(found.steps[i].cost == 2);
  }
  CHECK(found.paths[0].cost == 1 + 3 + 3);
  CHECK(found.paths[0].radiance == doctest::Approx(0.5 * (4 + 8 + 12 + 10 + 20)));
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

TEST_CASE("outcomes: steps from mirrors teach nothing") {
  PathLog log;
  test::add_path(log, 8, 1, 1);
  log.vertex(1).guidable = false;
  CHECK(Outcomes(log).steps.empty());
  CHECK(Outcomes(log).paths[0].radiance == doctest::Approx(4));
}

}  // namespace pharos
