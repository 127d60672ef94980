#include "learner.h"

#include "lessons.h"
#include "model.h"

namespace pharos::spatial_gaussians {

void SpatialGaussiansSettings::describe(Schema<SpatialGaussiansSettings>& s) {
  using S = SpatialGaussiansSettings;
  describe_mixture_learning(s);
  s.field("prior_counts", &S::prior_counts,
          "Prior number of samples per component (Dirichlet prior)")
      .above(0);
  s.field("prior_strength", &S::prior_strength,
          "Prior number of samples that say that a component is round, with the variance of the "
          "cell's first samples of their kind (inverse Wishart prior)")
      .above(0);
  s.field("largest_concentration", &S::largest_concentration,
          "Upper bound of the squared ratio of a component's distance to its smallest standard "
          "deviation; the distance is from the middle of the cell")
      .above(0);
  s.field("least_size", &S::least_size,
          "Lower bound of standard deviations, relative to the diagonal of the scene")
      .above(0);
  s.field("environment_distance", &S::environment_distance,
          "Distance at which the environment is placed, relative to the diagonal of the scene")
      .at_least(2);
}

SpatialGaussiansLearner::SpatialGaussiansLearner(const Settings& settings) : settings_(settings) {
  settings.check();
}

LearnerTraits SpatialGaussiansLearner::traits() const {
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> SpatialGaussiansLearner::begin(
    const LearningContext& context) const {
  return std::make_unique<KdTreeLearning<SpatialGaussiansLessons>>(
      SpatialGaussiansLessons(settings_, context));
}

std::shared_ptr<GuidingModel> SpatialGaussiansLearner::empty_model() const {
  return std::make_shared<SpatialGaussiansModel>();
}

}  // namespace pharos::spatial_gaussians
