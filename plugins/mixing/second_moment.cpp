#include "second_moment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pharos {
namespace {

constexpr int kSteps = 100;

/// Returns the density of a step under some shares, relative to the density with which it was
/// drawn.
double density_under(const FoundStep& step, const Simplex& shares, std::size_t count) {
  double q = 0;
  for (std::size_t i = 0; i < count; ++i) q += shares[i] * step.ratios[i];
  return q;
}

/// Adds up, for each technique, weight ratio / q^2: minus the derivative of second_moment() by the
/// technique's share.
Simplex descent_of(std::span<const FoundStep> steps, const Simplex& shares, std::size_t count) {
  Simplex descent{};
  for (const FoundStep& step : steps) {
    const double q = density_under(step, shares, count);
    if (!(q > 0)) continue;
    const double factor = step.weight / (q * q);
    for (std::size_t i = 0; i < count; ++i) descent[i] += factor * step.ratios[i];
  }
  return descent;
}

}  // namespace

Simplex normalized(Simplex numbers) {
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  for (double& number : numbers) number /= sum;
  return numbers;
}

double second_moment(std::span<const FoundStep> steps, const Simplex& shares, std::size_t count) {
  double sum = 0;
  for (const FoundStep& step : steps) sum += step.weight / density_under(step, shares, count);
  return sum;
}

Simplex least_second_moment(std::span<const FoundStep> steps,
                            const std::array<bool, kMostTechniques>& allowed, std::size_t count) {
  Simplex shares{};
  double allowed_count = 0;
  for (std::size_t i = 0; i < count; ++i) allowed_count += allowed[i] ? 1 : 0;
  for (std::size_t i = 0; i < count; ++i) shares[i] = allowed[i] ? 1 / allowed_count : 0;
  if (allowed_count == 1) return shares;
  for (int step = 0; step < kSteps; ++step) {
    const Simplex descent = descent_of(steps, shares, count);
    if (!(*std::max_element(descent.begin(), descent.end()) > 0)) break;
    for (std::size_t i = 0; i < count; ++i) shares[i] *= std::sqrt(descent[i]);
    shares = normalized(shares);
  }
  return shares;
}

Simplex with_least_unguided(Simplex shares, double least, std::size_t count) {
  if (shares[0] >= least) return shares;
  const double factor = (1 - least) / (1 - shares[0]);
  shares[0] = least;
  for (std::size_t i = 1; i < count; ++i) shares[i] *= factor;
  return shares;
}

}  // namespace pharos
