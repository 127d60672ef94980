#include <vector>

#include <doctest/doctest.h>

#include <pharos/rendering/schedule.h>

namespace pharos {
namespace {

constexpr double kSecondsPerSample = 0.25, kUpdateSeconds = 0.125;

/// What rendering an iteration shows.
struct Machine {
  double seconds_per_sample = kSecondsPerSample;
  double guided_cost = 1;  ///< time of a sample of later iterations over one of the first
  double update_seconds = kUpdateSeconds;
  std::uint32_t region_minimum = 1;  ///< after the first iteration
  double largest_share = 1;          ///< after the first iteration
  std::size_t limited = 1000;        ///< number of iterations after which there is no limit
};

/// Runs a schedule as a render would, on a clock of its own. Returns the samples and the times that
/// the iterations took in `samples` and `seconds`.
struct Run {
  std::vector<Iteration> iterations;
  std::vector<std::uint32_t> samples;
  std::vector<double> seconds;

  std::uint32_t total() const {
    std::uint32_t sum = 0;
    for (const std::uint32_t each : samples) sum += each;
    return sum;
  }
};

Run run(const Budget& budget, const TrainingSettings& training, std::uint32_t granule = 1,
        const Machine& machine = {}) {
  Schedule schedule(budget, training, granule);
  Run result;
  Spending spent;
  while (const auto iteration = schedule.next(spent)) {
    const double per_sample =
        machine.seconds_per_sample * (iteration->index > 0 ? machine.guided_cost : 1);
    std::uint32_t done = 0;
    double taken = 0;
    while (done < iteration->samples &&
           (done < iteration->least_samples || spent.seconds + taken < iteration->deadline)) {
      ++done;
      taken += per_sample;
    }
    spent.samples += done;
    spent.seconds += taken;
    spent.seconds_per_sample = per_sample;
    if (iteration->training) {
      spent.update_seconds = machine.update_seconds;
      spent.seconds += machine.update_seconds;
      spent.region_minimum = machine.region_minimum;
      const bool is_limited = result.iterations.size() + 1 < machine.limited;
      spent.largest_share = is_limited ? machine.largest_share : 1;
    }
    result.iterations.push_back(*iteration);
    result.samples.push_back(done);
    result.seconds.push_back(taken);
  }
  return result;
}

TEST_CASE("uniform training gets its share, the rest goes to the image") {
  const Run all = run({.spp = 512}, {.iterations = 15, .share = 0.5});
  REQUIRE(all.iterations.size() == 16);
  for (std::uint32_t i = 0; i < 15; ++i) {
    CHECK(all.iterations[i].samples == 17);
    CHECK(all.iterations[i].training);
    CHECK(all.iterations[i].training_left == 14 - i);
  }
  CHECK(all.iterations[15].samples == 512 - 15 * 17);
  CHECK_FALSE(all.iterations[15].training);
}

TEST_CASE("geometric training doubles") {
  const Run all = run({.spp = 64}, {.schedule = ScheduleKind::geometric, .iterations = 4});
  CHECK(all.samples == std::vector<std::uint32_t>{2, 4, 8, 16, 34});
}

TEST_CASE("small budgets make fewer iterations, never empty ones") {
  for (const ScheduleKind kind : {ScheduleKind::uniform, ScheduleKind::geometric}) {
    for (const std::uint32_t spp : {1u, 2u, 3u, 7u, 20u, 100u}) {
      for (const std::uint32_t granule : {1u, 4u, 16u}) {
        const Run all = run({.spp = spp}, {.schedule = kind, .iterations = 6}, granule);
        CHECK(all.total() == spp);
        for (const std::uint32_t samples : all.samples) CHECK(samples > 0);
        CHECK_FALSE(all.iterations.back().training);
        const std::uint32_t last = all.samples.back();
        if (all.samples.size() > 1 && last > granule) CHECK(last % granule == 0);
      }
    }
  }
}

TEST_CASE("large sets of a sampler leave the number of iterations as it is") {
  const Run all = run({.spp = 256}, {.iterations = 15}, 64);
  REQUIRE(all.samples.size() == 16);
  for (std::size_t i = 0; i < 14; ++i) CHECK(all.samples[i] == 8);
  CHECK(all.samples[14] == 16);
  CHECK(all.samples[15] == 128);
}

TEST_CASE("uniform training in seconds has equal parts, updates included") {
  const Run all = run({.seconds = 40.0}, {.iterations = 4, .share = 0.7});
  REQUIRE(all.iterations.size() == 5);
  for (std::uint32_t i = 0; i < 4; ++i) {
    CHECK(all.iterations[i].deadline == doctest::Approx(7 * (i + 1)));
    CHECK(all.iterations[i].training_left == 3 - i);
  }
  CHECK(all.iterations[4].deadline == 40);
}

TEST_CASE(
    "geometric training in seconds counts whole passes, and its last iteration takes the rest") {
  const Run all =
      run({.seconds = 40.0}, {.schedule = ScheduleKind::geometric, .iterations = 15, .share = 0.5});
  // Two samples take a hundredth of the time. They and 4, 8 and 16 samples take 8 s with their
  // updates. 32 samples would take 8.125 s, which leaves 3.9 s: not enough for 64.
  REQUIRE(all.samples.size() == 6);
  CHECK(all.iterations[0].deadline == doctest::Approx(0.4));
  for (std::size_t i = 0; i < 4; ++i) CHECK(all.samples[i] == 2u << i);
  CHECK(all.samples[4] > 32);
  CHECK(all.samples[4] < 64);
  CHECK(all.iterations[4].deadline == doctest::Approx(20 - kUpdateSeconds));
  CHECK(all.iterations[4].training_left == 0);
  CHECK(all.iterations[3].training_left == 1);
  CHECK_FALSE(all.iterations[5].training);
}

TEST_CASE("slow scenes and long updates still leave an image") {
  for (const ScheduleKind kind : {ScheduleKind::uniform, ScheduleKind::geometric}) {
    const Run all = run({.seconds = 1.0}, {.schedule = kind, .iterations = 8}, 1,
                        {.seconds_per_sample = 3, .update_seconds = 3});
    CHECK(all.iterations.front().training);
    CHECK_FALSE(all.iterations.back().training);
    CHECK(all.samples.back() == 1);
    CHECK(all.samples.size() <= 3);
  }
}

TEST_CASE("iterations give the regions of the models enough samples") {
  const Machine machine{.region_minimum = 12};
  CHECK(run({.spp = 80}, {.iterations = 10}, 1, machine).samples ==
        std::vector<std::uint32_t>{4, 12, 12, 12, 40});
  CHECK(run({.spp = 160}, {.schedule = ScheduleKind::geometric, .iterations = 10}, 1, machine)
            .samples == std::vector<std::uint32_t>{1, 12, 50, 97});
  const Run timed = run({.seconds = 40.0}, {.iterations = 20}, 1, machine);
  REQUIRE(timed.samples.size() > 3);
  CHECK(timed.samples[0] == 4);
  // Only the last training iteration, before the image, may have fewer.
  for (std::size_t i = 1; i + 2 < timed.samples.size(); ++i) CHECK(timed.samples[i] >= 12);
}

TEST_CASE("regions that need more samples than there is time for do not exceed the budget") {
  for (const ScheduleKind kind : {ScheduleKind::uniform, ScheduleKind::geometric}) {
    const Run all = run({.seconds = 40.0}, {.schedule = kind, .iterations = 8}, 1,
                        {.region_minimum = 1'000'000});
    double seconds = 0;
    for (const double each : all.seconds) seconds += each;
    CHECK(seconds < 42);
    CHECK(all.seconds.back() > 18);
  }
}

TEST_CASE("iterations that may take only a small share of the budget are shorter and more") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  const Machine machine{.largest_share = 1.0 / 16};
  // Without the limit: 1, 2, 4, 8, 16, 32 samples, then the image.
  const Run counted = run({.spp = 128}, geometric, 1, machine);
  CHECK(counted.samples == std::vector<std::uint32_t>{1, 2, 4, 8, 8, 8, 8, 8, 8, 8, 65});
  for (std::uint32_t i = 1; i < 10; ++i) CHECK(counted.iterations[i].training_left == 9 - i);
  const Run timed = run({.seconds = 40.0}, geometric, 1, machine);
  REQUIRE(timed.samples.size() > 8);
  for (std::size_t i = 1; i + 1 < timed.samples.size(); ++i) {
    CHECK(timed.seconds[i] + kUpdateSeconds <= 2.5);
    const bool is_last = i + 2 == timed.samples.size();
    CHECK((timed.iterations[i].training_left == 0) == is_last);
  }
  CHECK(timed.seconds.back() < 23);
}

TEST_CASE("a small share of the budget: no iteration is tiny because little is left") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  CHECK(run({.spp = 1000}, geometric, 1, {.largest_share = 1.0 / 16}).samples ==
        std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 62, 62, 62, 751});
  const Machine regions{.region_minimum = 20, .largest_share = 0.01};
  CHECK(run({.spp = 128}, geometric, 1, regions).samples ==
        std::vector<std::uint32_t>{1, 20, 20, 20, 67});
  CHECK(run({.spp = 128}, geometric, 64, regions).total() == 128);
}

TEST_CASE("a small share of the budget: a share of whole samples is not rounded down") {
  Schedule schedule({.spp = 100}, {.schedule = ScheduleKind::geometric, .share = 0.9}, 1);
  Spending spent;
  for (const std::uint32_t samples : {1u, 2u, 4u, 8u}) {
    CHECK(schedule.next(spent)->samples == samples);
    const double before = schedule.fraction(spent.samples, 0);
    spent.samples += samples;
    spent.largest_share = 2 * (schedule.fraction(spent.samples, 0) - before);
  }
  CHECK(schedule.next(spent)->samples == 16);
}

TEST_CASE("a small share of the budget: uniform training is shorter") {
  CHECK(run({.spp = 96}, {.iterations = 3}, 1, {.largest_share = 1.0 / 16}).samples ==
        std::vector<std::uint32_t>{16, 6, 6, 68});
  const Run timed = run({.seconds = 40.0}, {.iterations = 4}, 1, {.largest_share = 1.0 / 16});
  REQUIRE(timed.seconds.size() == 5);
  for (std::size_t i = 1; i < 4; ++i) CHECK(timed.seconds[i] + kUpdateSeconds <= 2.5);
  // The second iteration ends with the first sample after 2.375 seconds.
  const Machine slow{.guided_cost = 8, .largest_share = 1.0 / 16};
  CHECK(run({.seconds = 40.0}, {.iterations = 4}, 1, slow).seconds[1] == 4);
}

TEST_CASE("a small share of the budget: doubling goes on where it stopped") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  CHECK(run({.spp = 512}, geometric, 1, {.largest_share = 1.0 / 64, .limited = 6}).samples ==
        std::vector<std::uint32_t>{1, 2, 4, 8, 8, 8, 16, 32, 176, 257});
}

TEST_CASE("a small share of the budget: long updates do not take most of the time") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  const Run timed =
      run({.seconds = 40.0}, geometric, 1, {.update_seconds = 1, .largest_share = 1.0 / 64});
  for (std::size_t i = 3; i + 1 < timed.seconds.size(); ++i) CHECK(timed.seconds[i] == 1);
}

TEST_CASE("a small share of the budget: samples that take longer than before are fewer") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  const Machine machine{.guided_cost = 8, .largest_share = 1.0 / 16};
  // The second iteration was to have four samples of a quarter of a second each.
  const Run timed = run({.seconds = 40.0}, geometric, 1, machine);
  CHECK(timed.samples[0] == 2);
  CHECK(timed.samples[1] == 2);
  CHECK(timed.seconds[1] == 4);  // it ends with the first sample after 2.375 seconds
  // All regions of the models get enough samples nevertheless.
  const Machine regions{.guided_cost = 8, .region_minimum = 3, .largest_share = 1.0 / 16};
  CHECK(run({.seconds = 40.0}, geometric, 1, regions).samples[1] == 3);
}

TEST_CASE("doubling goes on from what the last iteration had time for") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  const Machine machine{.guided_cost = 8, .largest_share = 1.0 / 16, .limited = 2};
  const Run timed = run({.seconds = 400.0}, geometric, 1, machine);
  CHECK(timed.samples[0] == 16);
  CHECK(timed.samples[1] == 13);  // of 32 that were wanted, in 24.875 seconds
  CHECK(timed.samples[2] == 26);
  CHECK(timed.iterations[2].training_left > 0);
}

TEST_CASE("a region minimum does not keep training from ending in time") {
  const TrainingSettings geometric{.schedule = ScheduleKind::geometric};
  const Machine machine{.guided_cost = 8, .region_minimum = 20};
  const Run timed = run({.seconds = 40.0}, geometric, 1, machine);
  CHECK(timed.seconds[1] <= 20);
  CHECK(timed.seconds.back() >= 18);
}

TEST_CASE("the number of training iterations is limited, however short they are") {
  const TrainingSettings training{.schedule = ScheduleKind::geometric, .iterations = 5};
  const Run all = run({.spp = 1024}, training, 1, {.largest_share = 1.0 / 128});
  CHECK(all.samples == std::vector<std::uint32_t>{16, 8, 8, 8, 8, 976});
}

TEST_CASE("training can end early, and the image gets the rest") {
  Schedule schedule({.spp = 100}, {.iterations = 5}, 1);
  const auto first = schedule.next({});
  REQUIRE(first.has_value());
  schedule.end_training();
  const auto image = schedule.next({.samples = first->samples});
  REQUIRE(image.has_value());
  CHECK_FALSE(image->training);
  CHECK(image->samples == 90);
  CHECK_FALSE(schedule.next({.samples = 100}).has_value());
}

TEST_CASE("without training there is one iteration") {
  CHECK(run({.spp = 9}, {.iterations = 0}, 4).samples == std::vector<std::uint32_t>{9});
  CHECK(run({.seconds = 9.0}, {.share = 0}).samples.size() == 1);
}

TEST_CASE("the longest iteration and the progress of a budget") {
  CHECK(Schedule({.spp = 100}, {.iterations = 5, .share = 0.25}, 1).longest() == 75);
  CHECK(Schedule({.seconds = 100.0}, {}, 1).longest() == 0);
  CHECK(Schedule({.spp = 100}, {}, 1).fraction(25, 1e9) == 0.25);
  CHECK(Schedule({.seconds = 100.0}, {}, 1).fraction(1e9, 25) == 0.25);
  CHECK(Schedule({.seconds = 100.0}, {}, 1).fraction(0, 101) == 1);
}

}  // namespace
}  // namespace pharos
