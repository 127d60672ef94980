#include "class_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace pharos {
namespace {

using Settings = SimplexMixing::Settings;

/// Shares and what steps would cost under them.
struct Candidate {
  Simplex shares;
  double cost;
};

/// The steps of one iteration, and the rules by which shares are found for them.
class ShareSearch {
 public:
  ShareSearch(const std::vector<FoundStep>& steps, const Settings& settings, std::size_t count)
      : steps_(steps), settings_(settings), count_(count) {}

  /// Returns the best shares of the techniques that may be asked.
  Candidate best(const TechniqueSet& asked) const {
    const Simplex shares = with_least_unguided(
        least_cost(steps_, asked, count_, settings_.objective), settings_.least, count_);
    return {shares, cost_of(steps_, shares, count_, settings_.objective)};
  }
  /// Leaves methods out of the best shares of all techniques in use: one after another, the method
  /// without which the cost rises least, as long as it rises by less than the factor `worth`.
  Simplex worthwhile(Candidate now, TechniqueSet asked) const {
    while (true) {
      std::size_t cheapest = 0;
      Candidate next{now.shares, settings_.worth * now.cost};
      for (std::size_t i = 1; i < count_; ++i) {
        if (!asked[i]) continue;
        TechniqueSet without = asked;
        without[i] = false;
        const Candidate candidate = best(without);
        if (candidate.cost < next.cost) next = candidate, cheapest = i;
      }
      if (cheapest == 0) return now.shares;
      asked[cheapest] = false;
      now = next;
    }
  }

 private:
  std::span<const FoundStep> steps_;
  const Settings& settings_;
  std::size_t count_;
};

/// Sets the shares of techniques that are not in use to 0.
Simplex restricted(Simplex shares, const TechniqueSet& in_use) {
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = in_use[i] ? shares[i] : 0;
  return normalized(shares);
}

/// Returns `part` times new shares plus the rest of the known ones. A method whose new share is 0
/// keeps its part of the known one, unless the new shares count for more than half.
Simplex blended(const Simplex& found, double part, const Simplex& known) {
  Simplex shares{};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool is_dropped = i > 0 && found[i] == 0 && part > 0.5;
    if (!is_dropped) shares[i] = part * found[i] + (1 - part) * known[i];
  }
  return normalized(shares);
}

/// Gives each method in use at least its part of the share `explore`.
Simplex explored(Simplex shares, double explore, const TechniqueSet& in_use) {
  const auto methods = std::count(in_use.begin() + 1, in_use.end(), true);
  for (std::size_t i = 1; i < shares.size(); ++i) {
    if (in_use[i]) shares[i] = std::max(shares[i], explore / static_cast<double>(methods));
  }
  return normalized(shares);
}

}  // namespace

ClassShares::ClassShares(const StagedShares& prior, const Settings& settings)
    : shares_(prior), steps_(settings.reservoir) {}

void ClassShares::add(const FoundStep& step, RandomStream& random) {
  steps_.insert(step, step.weight, random);
  weights_ += step.weight;
  squares_ += step.weight * step.weight;
}

void ClassShares::drop_steps() {
  steps_ = statistics::VarOptReservoir<FoundStep>(steps_.capacity());
  weights_ = squares_ = 0;
}

void ClassShares::learn(const Settings& settings, std::size_t count, const TechniqueSet& in_use,
                        const StagedShares& prior) {
  const double before = certainty_;
  if (before > 0) {
    own_.training = restricted(own_.training, in_use);
    own_.final = restricted(own_.final, in_use);
  }
  if (squares_ > 0) {
    std::vector<FoundStep> steps;
    steps_.for_each([&](FoundStep step, double weight) {
      step.weight = weight;
      steps.push_back(step);
    });
    const ShareSearch search(steps, settings, count);
    const Candidate best = search.best(in_use);
    const double worth = weights_ * weights_ / squares_;
    const double part = worth / (worth + before);
    own_.final = blended(search.worthwhile(best, in_use), part, own_.final);
    own_.training = blended(best.shares, part, own_.training);
    certainty_ += worth;
  }
  drop_steps();
  shares_ = prior;
  shares_.training = restricted(prior.training, in_use);
  shares_.final = restricted(prior.final, in_use);
  if (certainty_ > 0) {
    const double part = certainty_ / (certainty_ + settings.prior_steps);
    shares_.final = blended(own_.final, part, prior.found_light ? shares_.final : shares_.training);
    shares_.found_light = true;
    shares_.training =
        explored(blended(own_.training, part, shares_.training), settings.explore, in_use);
  }
  if (certainty_ > before) certainty_ *= settings.decay;
}

void ClassShares::archive(Archive& archive) {
  std::uint64_t capacity = steps_.capacity();
  archive(shares_, own_, certainty_, weights_, squares_, capacity);
  archive.expect(capacity > 0 && capacity <= SimplexMixing::Settings::kMostSteps,
                 "what was learned of mixing");
  if (archive.loads()) steps_ = statistics::VarOptReservoir<FoundStep>(capacity);
  archive(steps_);
  const auto is_simplex = [](const Simplex& shares) {
    double sum = 0;
    for (const double share : shares) sum += share;
    return shares[0] > 0 && std::abs(sum - 1) < 1e-6 &&
           *std::min_element(shares.begin(), shares.end()) >= 0;
  };
  const bool has_own = certainty_ == 0 || (is_simplex(own_.training) && is_simplex(own_.final));
  archive.expect(is_simplex(shares_.training) && is_simplex(shares_.final) && has_own &&
                     certainty_ >= 0 && weights_ >= 0 && squares_ >= 0,
                 "what was learned of mixing");
}

}  // namespace pharos
