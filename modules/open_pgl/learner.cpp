#include "learner.h"

#include "learning_state.h"
#include "model.h"

namespace pharos::open_pgl {

void OpenPglSettings::describe(Schema<OpenPglSettings>& s) {
  using S = OpenPglSettings;
  s.field("directions", &S::directions,
          "Directional distributions in the cells: von Mises-Fisher mixtures with or without "
          "parallax, or quadtrees");
  s.field("cell_samples", &S::cell_samples, "Number of samples after which a cell is divided")
      .at_least(64);
  s.field("max_depth", &S::max_depth, "Maximum number of dividing planes above a cell")
      .at_least(1)
      .at_most(32);
  s.field("neighbors", &S::neighbors,
          "Sometimes use a neighboring cell instead of the vertex's own, chosen by a hash of the "
          "vertex's position");
  s.field("batch_samples", &S::batch_samples,
          "Number of waiting samples (40 bytes each) at which the field learns from them before "
          "the iteration ends")
      .at_least(1024);
  s.field("least_pdf", &S::least_pdf, "Lower bound of the densities of samples")
      .unit("1/sr")
      .above(0);
  s.field("glossy", &S::glossy,
          "Roughness below which a surface acts as a mirror or lens: distances continue to the "
          "image behind it")
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
