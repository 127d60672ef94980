#include "step_cost.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pharos {
namespace {

constexpr int kSteps = 100;
/// The search ends when it changes no share by more than this [1]. The shares may still be further
/// from the best ones, but their cost hardly differs.
constexpr double kTolerance = 5e-4;

/// Returns the density of a step under some shares, relative to the density with which it was
/// drawn.
double density_under(const FoundStep& step, const Simplex& shares, std::size_t count) {
  double q = 0;
  for (std::size_t i = 0; i < count; ++i) q += shares[i] * step.ratios[i];
  return q;
}

/// Adds up, for each technique, minus the derivative of the sum of w / q, or of -w log q, by the
/// share of the technique.
template <std::size_t kCount>
Simplex descent_of(std::span<const FoundStep> steps, const Simplex& shares,
                   MixingObjective objective) {
  Simplex descent{};
  for (const FoundStep& step : steps) {
    const double q = density_under(step, shares, kCount);
    if (!(q > 0)) continue;
    const double factor = step.weight / (objective == MixingObjective::kl ? q : q * q);
    for (std::size_t i = 0; i < kCount; ++i) descent[i] += factor * step.ratios[i];
  }
  return descent;
}

/// The same for `count` techniques. The compiler unrolls loops of a known length.
Simplex descent_of(std::span<const FoundStep> steps, const Simplex& shares, std::size_t count,
                   MixingObjective objective) {
  switch (count) {
    case 2:
      return descent_of<2>(steps, shares, objective);
    case 3:
      return descent_of<3>(steps, shares, objective);
    case 4:
      return descent_of<4>(steps, shares, objective);
    default:
      return descent_of<kMostTechniques>(steps, shares, objective);
  }
}

}  // namespace

Simplex normalized(Simplex numbers) {
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  for (double& number : numbers) number /= sum;
  return numbers;
}

double cost_of(std::span<const FoundStep> steps, const Simplex& shares, std::size_t count,
               MixingObjective objective) {
  double sum = 0, weights = 0;
  for (const FoundStep& step : steps) {
    const double q = density_under(step, shares, count);
    sum += objective == MixingObjective::kl ? -step.weight * std::log(q) : step.weight / q;
    weights += step.weight;
  }
  return objective == MixingObjective::kl ? std::exp(sum / weights) : sum / weights;
}

Simplex least_cost(std::span<const FoundStep> steps, const TechniqueSet& allowed, std::size_t count,
                   MixingObjective objective) {
  Simplex shares{};
  for (std::size_t i = 0; i < count; ++i) shares[i] = allowed[i] ? 1 : 0;
  shares = normalized(shares);
  for (int step = 0; step < kSteps; ++step) {
    const Simplex descent = descent_of(steps, shares, count, objective);
    if (!(*std::max_element(descent.begin(), descent.end()) > 0)) break;
    const Simplex before = shares;
    for (std::size_t i = 0; i < count; ++i) {
      shares[i] *= objective == MixingObjective::kl ? descent[i] : std::sqrt(descent[i]);
    }
    shares = normalized(shares);
    double change = 0;
    for (std::size_t i = 0; i < count; ++i) {
      change = std::max(change, std::abs(shares[i] - before[i]));
    }
    if (change < kTolerance) break;
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
