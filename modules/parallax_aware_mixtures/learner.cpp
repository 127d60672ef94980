#include "learner.h"

#include <pharos/core/error.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "learning.h"
#include "model.h"

namespace pharos::parallax_aware_mixtures {

void ParallaxAwareMixturesSettings::describe(Schema<ParallaxAwareMixturesSettings>& s) {
  using S = ParallaxAwareMixturesSettings;
  s.field("spatial", &S::spatial,
          "A mixture for each cell of a growing tree, or a single one for the whole scene");
  s.field("parallax", &S::parallax,
          "Remember how far away light is, and let lobes point there from everywhere in the cell");
  s.field("cell_samples", &S::cell_samples,
          "Samples after which a cell is divided, at their mean across the axis of their largest "
          "variance")
      .at_least(64);
  s.field("max_depth", &S::max_depth, "Planes above the deepest cell at most")
      .at_least(0)
      .at_most(KdTree::kMostLevels);
  s.field("batch_samples", &S::batch_samples,
          "Samples that wait at most (36 bytes each): when there are more, they are learned from "
          "before the iteration ends")
      .at_least(1024);
  s.field("components", &S::components, "Lobes of a mixture at first").at_least(1).at_most(1024);
  s.field("most_components", &S::most_components, "Lobes of a mixture at most")
      .at_least(1)
      .at_most(1024);
  s.field("first_kappa", &S::first_kappa, "Concentration of the lobes before the first fit")
      .above(0)
      .at_most(1e6);
  s.field("first_samples", &S::first_samples,
          "Samples that found something, before a cell's first mixture is fitted")
      .at_least(2);
  s.field("em_iterations", &S::em_iterations, "Steps of a fit at most").at_least(1);
  s.field("em_tolerance", &S::em_tolerance,
          "A fit ends when a step raises its objective, a logarithm, by less for each sample")
      .at_least(0);
  s.field("prior_share", &S::prior_share,
          "What every lobe is believed to have seen, relative to all that was seen")
      .above(0);
  s.field("prior_strength", &S::prior_strength,
          "Samples without any preference that every lobe is believed to have seen besides")
      .above(0);
  s.field("most_kappa", &S::most_kappa, "Largest concentration of a lobe").at_least(1).at_most(1e6);
  s.field("split_threshold", &S::split_threshold,
          "Chi-square divergence above which a lobe is split")
      .above(0);
  s.field("least_density", &S::least_density,
          "Stands below the mixture in that divergence, in units of a uniform density")
      .at_least(1e-6)
      .at_most(1);
  s.field("split_samples", &S::split_samples, "Samples that a lobe is judged by before it is split")
      .at_least(1);
  s.field("merge_threshold", &S::merge_threshold,
          "Chi-square cost below which two lobes are merged")
      .at_least(0);
  s.field("merge_samples", &S::merge_samples, "Samples from one merging to the next").at_least(1);
  s.field("decay", &S::decay, "Share of what was learned that is kept for the next iteration")
      .at_least(0)
      .at_most(1);
  s.field("division_decay", &S::division_decay, "The same when a cell is divided")
      .at_least(0)
      .at_most(1);
  s.field("least_pdf", &S::least_pdf, "Counts in place of smaller densities of samples")
      .unit("1/sr")
      .above(0);
  s.field("glossy", &S::glossy,
          "Roughness below which a surface shows what is behind it: distances go on there")
      .at_least(0)
      .at_most(1);
  s.example("{ spatial: single, parallax: false, components: 5, most_components: 12 }");
}

ParallaxAwareMixturesLearner::ParallaxAwareMixturesLearner(const Settings& settings)
    : settings_(settings) {
  if (settings.components > settings.most_components) {
    throw InputError("expected at least as many `most_components` as `components`");
  }
}

LearnerTraits ParallaxAwareMixturesLearner::traits() const {
  return {.model = ParallaxAwareMixturesModel::kName,
          .records = {.light_samples = true},
          .model_version = ParallaxAwareMixturesModel::kVersion};
}

std::unique_ptr<LearningState> ParallaxAwareMixturesLearner::begin(const LearningContext&) const {
  return std::make_unique<KdTreeLearning<ParallaxAwareMixturesLearning>>(
      ParallaxAwareMixturesLearning(settings_));
}

std::shared_ptr<const GuidingModel> ParallaxAwareMixturesLearner::load_model(
    std::istream& in) const {
  return std::make_shared<ParallaxAwareMixturesModel>(in);
}

}  // namespace pharos::parallax_aware_mixtures
