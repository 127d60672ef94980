// adjoint: roulette and splitting driven by the expected contribution of a path (Vorba and Krivanek
// 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation").
//
// Let T be the throughput of a path at a vertex, Psi the radiance that leaves the vertex back along
// the path without its own emission, and I the radiance of the pixel. The path is expected to
// contribute
//
//     v = T Psi / (I + e)
//
// times the value of its pixel. If guides of the camera choose film positions, T is without the
// factor with which they have done so: they know which pixels need more paths, and roulette and
// splitting must not undo it. The offset e keeps dark pixels from splitting without limit.
// Contributions within a weight window [a, s a], a = 2 / (1 + s), are left alone (sections 4 and 5;
// the middle of the window is 1). Below the window the path plays roulette, and above it the path
// splits, so that each branch is on the edge of the window:
//
//     q = v / a if v < a,      q = v / (s a) if v > s a,      q = 1 otherwise.
//
// Psi is learned in bins of direction in the cells of a kd-tree (outcome_cells.h). I is a denoised
// image of the training iterations. The paper learns both before rendering by photon maps; here
// they are learned in the training iterations, which also count in the image, as in the program of
// the authors of EARS (Rath et al. 2022). In contrast to it, v is a mean over the channels of each
// factor.
//
// Light samples split and end together with the steps.
//
// Paths are left alone before the vertex `depth`, at vertices whose events are all discrete, and
// where no light was found, because the light there may be rare.
//
//     termination: { type: adjoint, window: 5 }
#include "adjoint.h"

#include <utility>

namespace pharos {
namespace {

class AdjointRule final : public TerminationRule {
 public:
  AdjointRule(const AdjointTermination::Settings& settings,
              std::shared_ptr<const LearnedOutcomes> known)
      : settings_(settings), known_(std::move(known)) {}

  BranchFactors factors(const TerminationQuery& query) const override {
    if (settings_.spares(query)) return {};
    const float radiance = known_->at(query).radiance;
    if (!(radiance > 0)) return {};
    const float throughput = mean(query.throughput) / query.film_weight;
    const float contribution = throughput * radiance / known_->scale_at(query.film);
    const float factor = settings_.clamped(weight_window_factor(contribution, settings_.window),
                                           known_->branches_left(query));
    return {factor, factor};
  }

 private:
  AdjointTermination::Settings settings_;
  std::shared_ptr<const LearnedOutcomes> known_;
};

}  // namespace

float weight_window_factor(float contribution, float width) {
  const float low = 2 / (1 + width), high = width * low;
  if (contribution < low) return contribution / low;
  return contribution > high ? contribution / high : 1;
}

void AdjointTermination::Settings::describe(Schema<Settings>& s) {
  s.field("window", &Settings::window, "Upper over lower bound of the weight window")
      .at_least(1)
      .at_most(1000);
  describe_outcomes(s);
  s.example("{ window: 2, most: 4, direction_rows: 2, cell_steps: 200, least_steps: 50 }");
}

std::unique_ptr<TerminationState> AdjointTermination::begin(const LearningContext& context) const {
  return std::make_unique<OutcomeLearning>(settings_, context, [settings = settings_](auto known) {
    return std::make_shared<const AdjointRule>(settings, std::move(known));
  });
}

}  // namespace pharos
