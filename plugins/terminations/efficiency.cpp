// efficiency: roulette and splitting that maximize the efficiency of the image, 1 / (variance times
// cost) (Rath et al. 2022, "EARS: Efficiency-Aware Russian Roulette and Splitting").
//
// Let T be the throughput of a path at a vertex, I the radiance of its pixel, and X the estimate of
// the radiance that a step from the vertex finds, of second moment E[X^2], variance V and cost C.
// Let C_I be the mean cost of a path, and V_I the mean squared error of a path relative to its
// pixel, (value - I)^2 / (I + e)^2. If guides of the camera choose film positions, the factor with
// which they have done so is part of T, and its square is part of the squared error. The best
// number of steps is (sections 4 and 5)
//
//     q_s = T / (I + e) sqrt(V      / C  C_I / V_I)     for splitting,
//     q_r = T / (I + e) sqrt(E[X^2] / C  C_I / V_I)     for roulette.
//
// Roulette is played if q_r < 1, and the path splits if q_s > 1. Otherwise it goes on undivided. So
// it does before the vertex `depth`, and at vertices whose events are all discrete. The offset e
// keeps dark pixels from taking all the time. The number of light samples follows from their own
// E[X^2], V and C in the same way. Both are independent estimates of parts of the same radiance, so
// the variance of the sum is the sum of the variances.
//
// The variances and costs depend on the factors of all later vertices and of the whole image. V,
// E[X^2] and C accumulate in bins of direction in the cells of a kd-tree (outcome_cells.h). V_I and
// C_I are measured in the last iteration alone (image_error.h). The next factors follow from them:
// a fixed-point iteration. Costs are numbers of steps and light samples. I is a denoised image of
// all training iterations (film_estimate.h).
//
// This follows the program of the authors, with some differences on purpose:
//
// - Rare large errors are limited in V_I, and T X is limited alike in V (outcome_settings.h). The
//   program leaves the largest errors out of V_I alone, so V_I has less noise than V suggests, and
//   paths split more and more from iteration to iteration. E[X^2] has no limit, because roulette
//   must expect rare light.
// - The program takes a light sample with each step, and X is what both find. Here light samples
//   have a factor of their own; Meyer et al. (2024, "MARS: Multi-sample Allocation through Russian
//   roulette and Splitting") choose the numbers of samples of several techniques likewise. Where
//   lights are out of sight, light samples are rare.
// - The number of branches into which a path may split grows from iteration to iteration, see
//   `growth`. Otherwise the first factors follow from paths that did not split, and each vertex
//   splits as if it alone had to remove the whole variance.
// - Numbers are means over the channels of each factor, so that a bin has one number of each kind.
// - If training ends before the first three iterations are over, the final image uses what was
//   learned nevertheless.
// - Training images are weighted by the budget that they took (image_combiner.h). Weights by
//   inverse variances depend on the values that they weight, which would bias the image.
//
//     termination: { type: efficiency, most: 20 }
#include "efficiency.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pharos {
namespace {

class EfficiencyRule final : public TerminationRule {
 public:
  EfficiencyRule(const OutcomeSettings& settings, std::shared_ptr<const LearnedOutcomes> known)
      : settings_(settings),
        known_(std::move(known)),
        worth_(static_cast<float>(std::sqrt(known_->path_cost / known_->squared_error))) {}

  BranchFactors factors(const TerminationQuery& query) const override {
    if (settings_.spares(query)) return {};
    const ExpectedOutcome& expected = known_->at(query);
    const float relative = worth_ * mean(query.throughput) / known_->scale_at(query.film);
    const auto best = [&](const Spread& spread) {
      return settings_.clamped(efficiency_factor(relative, spread), known_->branches_left(query));
    };
    return {best(expected.step), best(expected.light)};
  }

 private:
  OutcomeSettings settings_;
  std::shared_ptr<const LearnedOutcomes> known_;
  float worth_;  ///< sqrt(C_I / V_I)
};

}  // namespace

float efficiency_factor(float relative, const Spread& spread) {
  const float roulette = relative * spread.squared;
  return roulette < 1 ? roulette : std::max(relative * spread.variance, 1.0f);
}

void EfficiencyTermination::Settings::describe(Schema<Settings>& s) {
  describe_outcomes(s);
  s.example("{ least: 0.2, most: 4, direction_rows: 2, cell_steps: 200, least_steps: 50 }");
}

std::unique_ptr<TerminationState> EfficiencyTermination::begin(
    const LearningContext& context) const {
  return std::make_unique<OutcomeLearning>(
      settings_, context,
      [settings = settings_](auto known) -> std::shared_ptr<const TerminationRule> {
        // Without noise there is nothing to gain. After a single iteration it is unknown.
        if (!(known->squared_error > 0)) return nullptr;
        return std::make_shared<const EfficiencyRule>(settings, std::move(known));
      });
}

}  // namespace pharos
