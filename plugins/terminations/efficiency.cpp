// efficiency: roulette and splitting that maximize the efficiency of the image, 1 / (variance times
// cost) (Rath et al. 2022, "EARS: Efficiency-Aware Russian Roulette and Splitting").
//
// Let T be the throughput of a path at a vertex, I the radiance of its pixel, and X the estimate of
// the radiance that a step from the vertex finds, of second moment E[X^2], variance V and cost C.
// Let C_I be the mean cost of a path, and V_I the mean of the variance of a path relative to I^2.
// The best numbers of steps are (sections 4 and 5)
//
//     q_s = T / I sqrt(V      / C  C_I / V_I)     for splitting,
//     q_r = T / I sqrt(E[X^2] / C  C_I / V_I)     for roulette.
//
// Roulette is played if q_r < 1, and the path splits if q_s > 1. Otherwise it goes on undivided.
//
// The variances and costs depend on the factors of all later vertices and of the whole image. They
// are measured in each iteration with the factors of that iteration, and the next factors follow
// from them: a fixed-point iteration. Costs are numbers of steps. V, E[X^2] and C are learned in
// bins of direction in the cells of a kd-tree (outcome_cells.h).
//
// The paper splits steps together with the light samples of the vertex. Here each vertex takes its
// light samples once, so X does not contain them.
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
        worth_(static_cast<float>(known_->path_cost / known_->path_variance)) {}

  float factor(const TerminationQuery& query) const override {
    const float relative = mean(query.throughput) / known_->pixels.at(query.film);
    const ExpectedOutcome& expected = known_->steps.at(query.position, query.towards_previous);
    return settings_.clamped(efficiency_factor(relative, expected, worth_));
  }

 private:
  OutcomeSettings settings_;
  std::shared_ptr<const LearnedOutcomes> known_;
  float worth_;
};

}  // namespace

float efficiency_factor(float relative, const ExpectedOutcome& expected, float worth) {
  const auto best = [&](float spread) {
    return relative * std::sqrt(spread / expected.cost * worth);
  };
  const float roulette = best(expected.squared);
  if (roulette < 1) return roulette;
  return std::max(best(expected.variance()), 1.0f);
}

void EfficiencyTermination::Settings::describe(Schema<Settings>& s) {
  describe_outcomes(s);
  s.example("{ least: 0.2, most: 4, direction_rows: 2, decay: 1 }");
}

std::unique_ptr<TerminationState> EfficiencyTermination::begin(
    const LearningContext& context) const {
  return std::make_unique<OutcomeLearning>(
      settings_, context,
      [settings = settings_](auto known) -> std::shared_ptr<const TerminationRule> {
        // Without noise there is nothing to gain.
        if (!(known->path_variance > 0)) return nullptr;
        return std::make_shared<const EfficiencyRule>(settings, std::move(known));
      });
}

}  // namespace pharos
