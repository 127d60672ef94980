// Expected power spectra of samplers against closed forms, with sinc(x) = sin(pi x) / (pi x). If n
// points lie one each in n equal strata, uniformly and unrelated, their power is 1 minus the
// squared Fourier coefficient of a stratum.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/point_sets.h>

#include "../multi_jittered.h"
#include "../pmj02.h"
#include "../pmj02bn.h"
#include "../sheared.h"
#include "../sobol.h"
#include "../stratified.h"
#include "../z_sobol.h"
#include "point_lists.h"

namespace pharos {
namespace {

constexpr int kMost = 12;
constexpr int kPixels = 600;
constexpr Dimension kDimension{Purpose::light_position, 1};

/// Averages over pixels. Each pixel has its own seed, because z_sobol relates pixels of one seed.
statistics::PowerSpectrum spectrum_of(const Sampler& sampler, std::uint32_t samples) {
  const auto prepared =
      sampler.prepare({40, 40}, {.seed = 2, .samples_per_pixel = samples}, nullptr);
  statistics::PowerSpectrum spectrum(kMost);
  for (std::uint64_t pixel = 0; pixel < kPixels; ++pixel) {
    const PathKey key{.seed = pixel, .index = pixel};
    spectrum.add(test::points_of(*prepared, key, kDimension, samples));
  }
  return spectrum;
}

double squared_sinc(double x) {
  const double angle = 3.14159265358979323846 * x;
  return x == 0 ? 1 : std::pow(std::sin(angle) / angle, 2);
}

/// The standard deviation of one realization's power is about its mean. Allows six times the error.
bool is_near(double power, double expected) {
  return std::abs(power - expected) < 6 * expected / std::sqrt(kPixels);
}

}  // namespace

TEST_CASE("spectra: stratified points have that of jittering, 1 - sinc^2") {
  // The grid has 4 by 8 cells.
  const auto spectrum = spectrum_of(StratifiedSampler(), 32);
  for (int y = -kMost; y <= kMost; ++y) {
    for (int x = 0; x <= kMost; ++x) {
      if (x == 0 && y == 0) continue;
      CAPTURE(x);
      CAPTURE(y);
      CHECK(is_near(spectrum.at(x, y), 1 - squared_sinc(x / 4.0) * squared_sinc(y / 8.0)));
    }
  }
}

TEST_CASE("spectra: the axes of multi-jittered points and of nets are dark") {
  const auto dark = [](const std::string& name, const Sampler& sampler, double most) {
    CAPTURE(name);
    const auto spectrum = spectrum_of(sampler, 64);
    for (int f = 1; f <= kMost; ++f) {
      CAPTURE(f);
      const double expected = 1 - squared_sinc(f / 64.0);
      CHECK(spectrum.at(f, 0) < most * expected);
      CHECK(spectrum.at(0, f) < most * expected);
      CHECK(spectrum.at(f, 0) > expected / most);
      CHECK(spectrum.at(0, f) > expected / most);
    }
  };
  dark("multi_jittered", MultiJitteredSampler(), 1.25);
  dark("uncorrelated", MultiJitteredSampler({.correlated = false}), 1.25);
  dark("sobol", SobolSampler(), 1.25);
  dark("z_sobol", ZSobolSampler(), 1.25);
  // These two samplers have only few sequences.
  dark("pmj02", Pmj02Sampler(), 2);
  dark("pmj02bn", Pmj02bnSampler(), 2);
}

TEST_CASE("spectra: shearing turns an arm of the cross") {
  // At 45 degrees y moves by x: frequency (x, y) gets the power of frequency (x + y, y).
  const auto base = std::make_shared<MultiJitteredSampler>();
  const auto spectrum = spectrum_of(ShearedSampler({.base = base, .direction = 45}), 64);
  const auto unmoved = spectrum_of(*base, 64);
  for (int f = 1; f <= kMost; ++f) {
    CAPTURE(f);
    const double dark = 1 - squared_sinc(f / 64.0);
    CHECK(is_near(spectrum.at(-f, f), dark));
    CHECK(is_near(spectrum.at(f, 0), dark));
    CHECK(is_near(unmoved.at(0, f), dark));
    // Near frequency 8, the edge of the spectrum of the cells, all powers are low.
    if (f > 6) continue;
    CHECK(spectrum.at(0, f) > 2 * dark);
    CHECK(unmoved.at(-f, f) > 2 * dark);
  }
  for (int y = -kMost; y <= kMost; ++y) {
    for (int x = std::max(-kMost, -kMost - y); x <= std::min(kMost, kMost - y); ++x) {
      if (x == 0 && y == 0) continue;
      CHECK(spectrum.at(x, y) == doctest::Approx(unmoved.at(x + y, y)).epsilon(0.001));
    }
  }
}

}  // namespace pharos
