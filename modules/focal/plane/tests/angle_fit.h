#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include <pharos/statistics/goodness_of_fit.h>

#include "../guide.h"

namespace pharos::focal::plane::testing {

/// Integrates with the midpoint rule.
template <class F>
double integrate(const F& f, double low, double high, int points) {
  double sum = 0;
  for (int i = 0; i < points; ++i) sum += f(low + (high - low) * (i + 0.5) / points);
  return sum * (high - low) / points;
}

/// The goodness of fit of sample() to pdf().
struct AngleFit {
  double p_value = 0;   ///< p-value of the chi-square test
  double integral = 0;  ///< integral of the density over all angles [1]
};

/// Tests samples against a density. The first half of the samples defines cells of equal counts.
/// The second half is compared with the integral of the density over each cell.
inline AngleFit fit_angles(const DirectionDensity& density, std::uint64_t seed) {
  constexpr int kDraws = 50'000, kCells = 200;
  RandomStream random(seed, 99);
  const auto draws = [&] {
    std::vector<double> angles;
    for (int i = 0; i < kDraws; ++i) angles.push_back(density.sample(random));
    std::sort(angles.begin(), angles.end());
    return angles;
  };
  const std::vector<double> first = draws(), second = draws();
  std::vector<double> observed, expected;
  double low = -std::numbers::pi / 2;
  auto from = second.begin();
  AngleFit fit;
  for (std::size_t cell = 1; cell <= kCells; ++cell) {
    const double high = cell == kCells ? std::numbers::pi / 2 : first[cell * kDraws / kCells];
    const auto to = std::lower_bound(from, second.end(), high);
    // Wide cells may contain narrow peaks, so the quadrature has at least one point every 2e-4.
    const int points = 100 + static_cast<int>((high - low) / 2e-4);
    const double mass = integrate([&](double a) { return density.pdf(a); }, low, high, points);
    observed.push_back(static_cast<double>(to - from));
    expected.push_back(mass * kDraws);
    fit.integral += mass;
    low = high;
    from = to;
  }
  fit.p_value = statistics::chi_square_test(observed, expected).p_value;
  return fit;
}

}  // namespace pharos::focal::plane::testing
