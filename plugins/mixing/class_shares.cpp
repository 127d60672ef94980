#include "class_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace pharos {
namespace {

using Settings = SimplexMixing::Settings;
using Asked = std::array<bool, kMostTechniques>;

/// The steps of one iteration, and the rules by which shares are found for them.
class ShareSearch {
 public:
  ShareSearch(const std::vector<FoundStep>& steps, const Settings& settings, std::size_t count)
      : steps_(steps), settings_(settings), count_(count) {}

  Asked all() const {
    Asked asked{};
    std::fill_n(asked.begin(), count_, true);
    return asked;
  }
  /// Returns the best shares of the techniques that may be asked.
  Simplex best(const Asked& asked) const {
    return with_least_unguided(least_cost(steps_, asked, count_, settings_.objective),
                               settings_.least, count_);
  }
  /// Leaves out, one after another, the method without which the cost rises least, as long as it
  /// rises by less than the factor `worth`.
  Asked worthwhile() const {
    Asked asked = all();
    double now = cost(asked);
    while (true) {
      std::size_t cheapest = 0;
      double next = settings_.worth * now;
      for (std::size_t i = 1; i < count_; ++i) {
        if (!asked[i]) continue;
        Asked without = asked;
        without[i] = false;
        const double value = cost(without);
        if (value < next) next = value, cheapest = i;
      }
      if (cheapest == 0) return asked;
      asked[cheapest] = false;
      now = next;
    }
  }

 private:
  double cost(const Asked& asked) const {
    return cost_of(steps_, best(asked), count_, settings_.objective);
  }

  std::span<const FoundStep> steps_;
  const Settings& settings_;
  std::size_t count_;
};

/// Returns `part` times new shares plus the rest of the known ones. Methods without a new share get
/// none.
Simplex blended(const Simplex& found, double part, const Simplex& known) {
  Simplex shares{};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (found[i] > 0 || i == 0) shares[i] = part * found[i] + (1 - part) * known[i];
  }
  return normalized(shares);
}

/// Gives each method at least its part of the share `explore`.
Simplex explored(Simplex shares, double explore, std::size_t count) {
  for (std::size_t i = 1; i < count; ++i) {
    shares[i] = std::max(shares[i], explore / static_cast<double>(count - 1));
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

void ClassShares::learn(const Settings& settings, std::size_t count, const StagedShares& prior) {
  const double before = certainty_;
  if (squares_ > 0) {
    std::vector<FoundStep> steps;
    steps_.for_each([&](FoundStep step, double weight) {
      step.weight = weight;
      steps.push_back(step);
    });
    const ShareSearch search(steps, settings, count);
    const double worth = weights_ * weights_ / squares_;
    own_.final = search.best(search.worthwhile());
    own_.training = blended(search.best(search.all()), worth / (worth + before), own_.training);
    certainty_ += worth;
  }
  drop_steps();
  shares_ = prior;
  if (certainty_ > 0) {
    const double part = certainty_ / (certainty_ + settings.prior_steps);
    shares_.final = blended(own_.final, part, prior.found_light ? prior.final : prior.training);
    shares_.found_light = true;
    shares_.training =
        explored(blended(own_.training, part, prior.training), settings.explore, count);
  }
  if (certainty_ > before) certainty_ *= settings.decay;
}

void ClassShares::archive(Archive& archive) {
  std::uint64_t capacity = steps_.capacity();
  archive(shares_.training, shares_.final, shares_.found_light, own_.training, own_.final,
          certainty_, weights_, squares_, capacity);
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
