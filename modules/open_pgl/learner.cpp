#include "learner.h"

#include "learning_state.h"
#include "model.h"

namespace pharos::open_pgl {

void OpenPglSettings::describe(Schema<OpenPglSettings>& s) {
  using S = OpenPglSettings;
  s.field("directions", &S::directions,
          "What cells hold: von Mises-Fisher mixtures with parallax or without, or quadtrees");
  s.field("cell_samples", &S::cell_samples, "Samples after which a cell is divided").at_least(64);
  s.field("max_depth", &S::max_depth, "Planes above the deepest cell at most")
      .at_least(1)
      .at_most(32);
  s.field("neighbors", &S::neighbors,
          "Sometimes take a neighboring cell instead of a vertex's own, by its position");
  s.field("batch_samples", &S::batch_samples,
          "Samples that wait at most (40 bytes each): when there are more, they are learned from "
          "before the iteration ends")
      .at_least(1024);
  s.field("least_pdf", &S::least_pdf, "Counts in place of smaller densities of samples")
      .unit("1/sr")
      .above(0);
  s.field("glossy", &S::glossy,
          "Roughness below which a surface shows what is behind it: distances go on there")
      .at_least(0)
      .at_most(1);
  s.example("{ directions: quadtree, neighbors: false }");
}

LearnerTraits OpenPglLearner::traits() const {
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> OpenPglLearner::begin(const LearningContext& context) const {
  return std::make_unique<OpenPglLearningState>(settings_, context.region);
}

std::shared_ptr<GuidingModel> OpenPglLearner::empty_model() const {
  return std::make_shared<OpenPglModel>();
}

}  // namespace pharos::open_pgl
