#include "learner.h"

#include <pharos/core/error.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "learning.h"
#include "model.h"

namespace pharos::spatial_gaussians {

void SpatialGaussiansSettings::describe(Schema<SpatialGaussiansSettings>& s) {
  using S = SpatialGaussiansSettings;
  s.field("spatial", &S::spatial,
          "A mixture for each cell of a growing tree, or a single one for the whole scene");
  s.field("cell_samples", &S::cell_samples,
          "Samples after which a cell is divided, at their mean across the axis of their largest "
          "variance")
      .at_least(64);
  s.field("max_depth", &S::max_depth, "Planes above the deepest cell at most")
      .at_least(0)
      .at_most(KdTree::kMostLevels);
  s.field("batch_samples", &S::batch_samples,
          "Samples that wait at most (32 bytes each): when there are more, they are learned from "
          "before the iteration ends")
      .at_least(1024);
  s.field("first_samples", &S::first_samples,
          "Samples that found something, before a cell's first mixture is fitted")
      .at_least(2);
  s.field("components", &S::components, "Gaussians of a mixture at first")
      .at_least(1)
      .at_most(1024);
  s.field("most_components", &S::most_components, "Gaussians of a mixture at most")
      .at_least(1)
      .at_most(1024);
  s.field("em_iterations", &S::em_iterations, "Steps of a fit at most").at_least(1);
  s.field("em_tolerance", &S::em_tolerance,
          "A fit ends when a step raises its objective, a logarithm, by less for each sample")
      .at_least(0);
  s.field("prior_counts", &S::prior_counts,
          "Samples that every component is believed to have (Dirichlet prior)")
      .above(0);
  s.field("prior_strength", &S::prior_strength,
          "Samples that the belief in a round component counts for (inverse Wishart prior); its "
          "variance is that of the cell's first samples")
      .above(0);
  s.field("largest_concentration", &S::largest_concentration,
          "Squared ratio of a component's distance from the middle of its cell to its least "
          "standard deviation, at most")
      .above(0);
  s.field("least_size", &S::least_size,
          "Least standard deviation, relative to the diagonal of the scene")
      .above(0);
  s.field("split_threshold", &S::split_threshold,
          "Directional chi-square divergence above which a component is split")
      .above(0);
  s.field("least_density", &S::least_density,
          "Stands below the mixture in that divergence, in units of a uniform density: what the "
          "mixture "
          "leaves out matters only as far as unguided samples do not find it")
      .at_least(1e-6)
      .at_most(1);
  s.field("split_samples", &S::split_samples,
          "Samples that a component is judged by before it is split")
      .at_least(1);
  s.field("merge_threshold", &S::merge_threshold,
          "Chi-square cost below which two components are merged")
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
  s.field("environment_distance", &S::environment_distance,
          "How far away the environment is taken to be, relative to the diagonal of the scene")
      .above(0);
}

SpatialGaussiansLearner::SpatialGaussiansLearner(const Settings& settings) : settings_(settings) {
  if (settings.components > settings.most_components) {
    throw InputError("expected at least as many `most_components` as `components`");
  }
}

LearnerTraits SpatialGaussiansLearner::traits() const {
  return {.model = std::string(kSpatialMixtureModel), .records = {.light_samples = true}};
}

std::unique_ptr<LearningState> SpatialGaussiansLearner::begin(
    const LearningContext& context) const {
  return std::make_unique<KdTreeLearning<SpatialGaussiansLearning>>(
      SpatialGaussiansLearning(settings_, context));
}

std::shared_ptr<const GuidingModel> SpatialGaussiansLearner::load_model(std::istream& in) const {
  return std::make_shared<SpatialGaussiansModel>(in);
}

}  // namespace pharos::spatial_gaussians
