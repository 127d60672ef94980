#include <doctest/doctest.h>

#include <pharos/rendering/schedule.h>

namespace pharos {
namespace {

std::uint32_t total(const std::vector<Iteration>& iterations) {
  std::uint32_t sum = 0;
  for (const Iteration& iteration : iterations) sum += iteration.samples;
  return sum;
}

TEST_CASE("uniform training gets its share, the rest goes to the image") {
  const TrainingSettings schedule{.iterations = 15, .share = 0.5};
  const auto iterations = divide({.spp = 512}, schedule, 1);
  REQUIRE(iterations.size() == 16);
  for (std::size_t i = 0; i < 15; ++i) {
    CHECK(iterations[i].samples == 17);
    CHECK(iterations[i].training);
    CHECK_FALSE(iterations[i].keeps_image);
  }
  CHECK(iterations[15].samples == 512 - 15 * 17);
  CHECK_FALSE(iterations[15].training);
  CHECK(iterations[15].keeps_image);
}

TEST_CASE("geometric training doubles") {
  const TrainingSettings schedule{
      .schedule = ScheduleKind::geometric, .iterations = 4, .images = TrainingImages::combine};
  const auto iterations = divide({.spp = 64}, schedule, 1);
  REQUIRE(iterations.size() == 5);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(iterations[i].samples == 2u << i);
    CHECK(iterations[i].keeps_image);
  }
  CHECK(total(iterations) == 64);
}

TEST_CASE("only the latest images are combined") {
  TrainingSettings schedule{.schedule = ScheduleKind::geometric,
                            .iterations = 5,
                            .images = TrainingImages::combine,
                            .latest_images = 3};
  for (const Budget& budget : {Budget{.spp = 64}, Budget{.seconds = 10.0}}) {
    const auto iterations = divide(budget, schedule, 1);
    REQUIRE(iterations.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(iterations[i].keeps_image == (i >= 3));
  }
  schedule.latest_images = 1;
  const auto iterations = divide({.spp = 64}, schedule, 1);
  CHECK_FALSE(iterations[4].keeps_image);
  CHECK(iterations[5].keeps_image);
}

TEST_CASE("small budgets make fewer iterations, never empty ones") {
  for (const ScheduleKind kind : {ScheduleKind::uniform, ScheduleKind::geometric}) {
    for (const std::uint32_t spp : {1u, 2u, 3u, 7u, 20u, 100u}) {
      for (const std::uint32_t granule : {1u, 4u, 16u}) {
        const TrainingSettings schedule{.schedule = kind, .iterations = 6};
        const auto iterations = divide({.spp = spp}, schedule, granule);
        CHECK(total(iterations) == spp);
        for (const Iteration& iteration : iterations) {
          CHECK(iteration.samples > 0);
        }
        CHECK_FALSE(iterations.back().training);
        const std::uint32_t last = iterations.back().samples;
        if (iterations.size() > 1 && last > granule) CHECK(last % granule == 0);
      }
    }
  }
}

TEST_CASE("large sets of a sampler leave the number of iterations as it is") {
  const TrainingSettings schedule{.iterations = 15};
  const auto iterations = divide({.spp = 256}, schedule, 64);
  REQUIRE(iterations.size() == 16);
  for (std::size_t i = 0; i < 14; ++i) CHECK(iterations[i].samples == 8);
  CHECK(iterations[14].samples == 16);
  CHECK(iterations[15].samples == 128);
}

TEST_CASE("seconds are divided in the same way") {
  TrainingSettings schedule{.iterations = 3, .share = 0.7};
  auto iterations = divide({.seconds = 10.0}, schedule, 1);
  REQUIRE(iterations.size() == 4);
  CHECK(iterations[0].seconds == doctest::Approx(7.0 / 3));
  CHECK(iterations[3].seconds == doctest::Approx(3));
  schedule.schedule = ScheduleKind::geometric;
  iterations = divide({.seconds = 10.0}, schedule, 1);
  CHECK(iterations[0].seconds == doctest::Approx(1));
  CHECK(iterations[2].seconds == doctest::Approx(4));
}

TEST_CASE("without training there is one iteration") {
  CHECK(divide({.spp = 9}, {.iterations = 0}, 4).size() == 1);
  CHECK(divide({.seconds = 9.0}, {.share = 0}, 1).size() == 1);
}

}  // namespace
}  // namespace pharos
