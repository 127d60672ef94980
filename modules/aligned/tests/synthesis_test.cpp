// Tests of synthesized sets: spectra, stratification, determinism and errors.

#include "../synthesis.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/core/error.h>

#include "../power_spectrum_loss.h"
#include "../wasserstein_loss.h"
#include "test_points.h"

namespace pharos::aligned {
namespace {

SynthesisSettings small(std::vector<double> directions = {30}) {
  SynthesisSettings settings;
  settings.points = 256;
  settings.directions = std::move(directions);
  settings.steps = 100;
  return settings;
}

std::vector<Direction> directions_of(const SynthesisSettings& settings) {
  std::vector<Direction> all{direction_of(0), direction_of(90)};
  for (const double d : settings.directions) all.push_back(direction_of(d));
  return all;
}

Coordinates coordinates_of(const PointSet& set) {
  Coordinates points(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) {
    points.x[i] = static_cast<double>(set[i].position().x);
    points.y[i] = static_cast<double>(set[i].position().y);
  }
  return points;
}

/// Returns the weighted mean power over the frequencies that the settings suppress.
double suppressed_power(const PointSet& set, const SynthesisSettings& settings) {
  const PowerSpectrumLoss loss(
      suppressed_frequencies(settings.points, directions_of(settings), settings.rule));
  Coordinates unused(set.size());
  return loss.evaluate(coordinates_of(set), 1, unused);
}

/// Returns the mean squared distance of projections from the centers of their strata [1/N^2].
double unevenness(const PointSet& set, const SynthesisSettings& settings) {
  Coordinates unused(set.size());
  const WassersteinLoss loss(directions_of(settings), set.size());
  return loss.evaluate(coordinates_of(set), 1, unused);
}

PointSet synthesized_by(int threads, const SynthesisSettings& settings) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  PointSet set;
  tbb::task_arena(threads).execute([&] { set = synthesize(settings).points; });
  return set;
}

}  // namespace

TEST_CASE("synthesis: spectra and projections far below those of a jittered grid") {
  for (const std::vector<double>& directions :
       {std::vector<double>{}, std::vector<double>{17}, std::vector<double>{50, 115}}) {
    CAPTURE(directions.size());
    SynthesisSettings settings = small(directions);
    settings.steps = 400;
    const Synthesis made = synthesize(settings);
    const PointSet start = jittered_grid(settings.points, settings.seed);
    CHECK(made.points.size() == settings.points);
    CHECK(made.frequencies > settings.points / 4);
    CHECK(suppressed_power(made.points, settings) < 0.25 * suppressed_power(start, settings));
    CHECK(unevenness(made.points, settings) < 0.25 * unevenness(start, settings));
    CHECK(made.history.size() == 400);
    CHECK(made.history.back().spectrum < made.history.front().spectrum);
    CHECK(made.history.back().wasserstein < made.history.front().wasserstein);
  }
}

TEST_CASE("synthesis: each loss alone does its part and not the other's") {
  SynthesisSettings spectrum = small(), wasserstein = small();
  spectrum.wasserstein = 0;
  wasserstein.spectrum = 0;
  wasserstein.steps = 300;
  const Synthesis a = synthesize(spectrum), b = synthesize(wasserstein);
  CHECK(suppressed_power(a.points, spectrum) < 0.5 * suppressed_power(b.points, spectrum));
  CHECK(unevenness(b.points, spectrum) < 0.2 * unevenness(a.points, spectrum));
  CHECK(a.history.back().wasserstein == 0);
  CHECK(b.history.back().spectrum == 0);
  CHECK(b.frequencies == 0);
}

TEST_CASE("synthesis: any other target by a mask") {
  // The target is the power of four independent points at one frequency, and zero in a row of other
  // frequencies.
  SynthesisSettings settings = small({});
  settings.wasserstein = 0;
  settings.mask = {{5, 3, 4, 4}};
  for (int x = 10; x < 20; ++x) settings.mask.push_back({x, -7});
  const std::vector<Vec2> points = positions(synthesize(settings).points);
  CHECK(testing::mean_power(points, std::vector<TargetPower>{{5, 3}}, 20) ==
        doctest::Approx(4).epsilon(0.05));
  settings.mask.erase(settings.mask.begin());
  CHECK(testing::mean_power(points, settings.mask, 20) < 0.05);
}

TEST_CASE("synthesis: the same bits for any number of threads, others for other seeds") {
  SynthesisSettings settings = small({75});
  settings.points = 1024;
  settings.steps = 12;
  const PointSet one = synthesized_by(1, settings);
  for (const int threads : {2, 3, 7}) CHECK(synthesized_by(threads, settings) == one);
  settings.seed = 2;
  CHECK(synthesized_by(2, settings) != one);
}

TEST_CASE("synthesis: told of its progress, and stopped") {
  SynthesisSettings settings = small();
  settings.steps = 10;
  std::atomic<bool> stop = false;
  std::vector<double> told;
  const Synthesis made = synthesize(settings, {.on_progress =
                                                   [&](double fraction) {
                                                     told.push_back(fraction);
                                                     stop = fraction >= 0.5;
                                                   },
                                               .stop = &stop});
  CHECK(made.points.empty());
  CHECK(made.history.size() == 6);
  CHECK(told.size() == 6);
  CHECK(told.front() == 0);
  CHECK(told.back() == doctest::Approx(0.5));
}

TEST_CASE("synthesis: what it cannot make is refused") {
  for (const std::uint32_t points : {0u, 32u, 100u, 1u << 17}) {
    SynthesisSettings settings;
    settings.points = points;
    CHECK_THROWS_AS(synthesize(settings), InputError);
  }
  SynthesisSettings nothing;
  nothing.spectrum = nothing.wasserstein = 0;
  CHECK_THROWS_AS(synthesize(nothing), InputError);
}

TEST_CASE("jittered grid: a point a cell, in two columns a row where it cannot be square") {
  for (const std::uint32_t points : {64u, 128u}) {
    const std::uint32_t columns = points == 64 ? 8 : 16;
    std::vector<int> counts(points);
    for (const Vec2 p : positions(jittered_grid(points, 3))) {
      const auto column = static_cast<std::uint32_t>(p.x * static_cast<float>(columns));
      const auto row = static_cast<std::uint32_t>(p.y * 8);
      ++counts[row * columns + column];
    }
    CHECK(std::ranges::count(counts, 1) == static_cast<std::ptrdiff_t>(points));
  }
}

}  // namespace pharos::aligned
