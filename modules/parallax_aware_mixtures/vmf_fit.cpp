#include "vmf_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pharos/core/parallel.h>
#include <pharos/statistics/von_mises_fisher.h>

#include "lobe_simd.h"

namespace pharos::parallax_aware_mixtures {
namespace {

/// Eight lobes, prepared for the E step.
struct LogLobes8 {
  LogLobes8(const Mixture& mixture, std::size_t first) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool is_lobe = first + i < mixture.size();
      const Lobe lobe = is_lobe ? mixture[first + i] : Lobe{};
      for (int axis = 0; axis < 3; ++axis) mean[axis][i] = static_cast<float>(lobe.mean[axis]);
      half_kappa[i] = static_cast<float>(0.5 * lobe.kappa);
      log_scale[i] = is_lobe ? static_cast<float>(std::log(
                                   lobe.weight * von_mises_fisher::mode_density(lobe.kappa)))
                             : -std::numeric_limits<float>::infinity();
    }
  }
  /// Returns the logarithms of the lobes' densities times their weights.
  Float8 operator()(Vec3 w) const { return log_scale - half_kappa * squared_distance(mean, w); }
  Float8 mean[3];
  Float8 half_kappa, log_scale;
};

struct Moments8 {
  Float8 weight{}, resultant[3]{};

  void add(const Float8& shares, Vec3 w) {
    weight += shares;
    resultant[0] += shares * w.x;
    resultant[1] += shares * w.y;
    resultant[2] += shares * w.z;
  }
  void add_to(std::span<Moments> moments) const {
    for (std::size_t i = 0; i < std::min(kLanes, moments.size()); ++i) {
      moments[i].weight += weight[i];
      for (int axis = 0; axis < 3; ++axis) moments[i].resultant[axis] += resultant[axis][i];
    }
  }
};

/// Adds up w log p, eight summands at a time. The logarithms of the standard library took a third
/// of an E step.
class WeightedLogs {
 public:
  /// Adds weight (most + log total), for a `total` above 0.
  void add(float weight, float most, float total) {
    weight_[count_] = weight;
    most_[count_] = most;
    total_[count_] = total;
    if (++count_ == kLanes) add_all();
  }
  double sum() {
    add_all();
    return pharos::sum(sum_);
  }

 private:
  void add_all() {
    sum_ += widened(weight_) * (widened(most_) + log(widened(total_)));
    weight_ = Float8{};
    count_ = 0;
  }

  Float8 weight_{}, most_{}, total_ = all8(1);
  Double8 sum_{};
  std::size_t count_ = 0;
};

/// The E step over few directions, so that sums in single precision are accurate enough.
void expect_part(std::span<const LogLobes8> lobes, std::span<const WeightedDirection> directions,
                 Expectation& result) {
  std::vector<Float8> terms(lobes.size());
  std::vector<Moments8> sums(lobes.size());
  WeightedLogs logs;
  for (const WeightedDirection& d : directions) {
    if (!(d.weight > 0)) continue;
    Float8 largest = all8(-std::numeric_limits<float>::infinity());
    for (std::size_t g = 0; g < lobes.size(); ++g) {
      terms[g] = lobes[g](d.direction);
      largest = larger(largest, terms[g]);
    }
    const float most = largest_of(largest);
    Float8 total8{};
    for (Float8& term : terms) {
      term = exp(term - most);
      total8 += term;
    }
    const float total = sum(total8), share = d.weight / total;
    logs.add(d.weight, most, total);
    for (std::size_t g = 0; g < lobes.size(); ++g) sums[g].add(share * terms[g], d.direction);
  }
  for (std::size_t g = 0; g < lobes.size(); ++g) {
    sums[g].add_to(std::span(result.moments).subspan(g * kLanes));
  }
  result.log_likelihood += logs.sum();
}

std::size_t number(const FitRules& rules, std::size_t i) {
  return rules.changing.empty() ? i : rules.changing[i];
}

}  // namespace

Expectation expectation(const Mixture& mixture, std::span<const WeightedDirection> directions) {
  std::vector<LogLobes8> lobes;
  for (std::size_t k = 0; k < mixture.size(); k += kLanes) lobes.emplace_back(mixture, k);
  constexpr std::size_t kPart = 4096, kBlock = 256;
  std::vector<Expectation> parts((directions.size() + kPart - 1) / kPart,
                                 {std::vector<Moments>(mixture.size()), 0});
  parallel_for(parts.size(), [&](std::size_t i) {
    const auto part = directions.subspan(i * kPart, std::min(kPart, directions.size() - i * kPart));
    for (std::size_t first = 0; first < part.size(); first += kBlock) {
      expect_part(lobes, part.subspan(first, std::min(kBlock, part.size() - first)), parts[i]);
    }
  });
  Expectation all{std::vector<Moments>(mixture.size()), 0};
  for (const Expectation& part : parts) {
    for (std::size_t k = 0; k < mixture.size(); ++k) all.moments[k] += part.moments[k];
    all.log_likelihood += part.log_likelihood;
  }
  return all;
}

void maximize(std::span<const Moments> moments, const FitRules& rules, Mixture& mixture) {
  const std::size_t count = rules.changing.empty() ? mixture.size() : rules.changing.size();
  double seen = 0;
  for (const Moments& m : moments) seen += m.weight;
  const double believed = rules.prior_share * seen;
  double total = 0, share = 0;  // of the lobes that may change
  for (std::size_t i = 0; i < count; ++i) {
    total += moments[number(rules, i)].weight + believed;
    share += mixture[number(rules, i)].weight;
  }
  if (!(total > 0)) return;
  const double most_cosine = von_mises_fisher::mean_cosine(rules.most_kappa);
  for (std::size_t i = 0; i < count; ++i) {
    const Moments& m = moments[number(rules, i)];
    Lobe& lobe = mixture[number(rules, i)];
    lobe.weight = (rules.changing.empty() ? 1 : share) * (m.weight + believed) / total;
    const double length = m.resultant.norm();
    if (!(length > 0)) continue;
    lobe.mean = m.resultant / length;
    const double cosine = length / (m.weight + rules.prior_strength);
    lobe.kappa = cosine < most_cosine ? von_mises_fisher::concentration(cosine) : rules.most_kappa;
  }
}

double objective(const Mixture& mixture, double log_likelihood, double seen,
                 const FitRules& rules) {
  double value = log_likelihood;
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const Lobe& lobe = mixture[k];
    const Moments old = rules.frozen.empty() ? Moments{} : rules.frozen[k];
    const double counts = old.weight + rules.prior_share * seen;
    if (counts > 0) value += counts * std::log(lobe.weight);
    value += (old.weight + rules.prior_strength) * von_mises_fisher::log_norm(lobe.kappa) +
             lobe.kappa * lobe.mean.dot(old.resultant);
  }
  return value;
}

std::vector<Moments> fit(Mixture& mixture, std::span<const WeightedDirection> directions,
                         const FitRules& rules) {
  double weight = 0, seen = 0;
  for (const WeightedDirection& d : directions) weight += d.weight;
  for (const Moments& m : rules.frozen) seen += m.weight;
  seen += weight;
  std::vector<Moments> result(mixture.size());
  double last = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < rules.most_iterations; ++i) {
    Expectation now = expectation(mixture, directions);
    const double reached = objective(mixture, now.log_likelihood, seen, rules);
    std::vector<Moments> moments = now.moments;
    for (std::size_t k = 0; k < rules.frozen.size(); ++k) moments[k] += rules.frozen[k];
    maximize(moments, rules, mixture);
    result = std::move(now.moments);
    if (reached - last < rules.tolerance * weight) break;
    last = reached;
  }
  return result;
}

}  // namespace pharos::parallax_aware_mixtures
