#include "learner.h"

#include "lessons.h"
#include "model.h"

namespace pharos::spatial_gaussians {

void SpatialGaussiansSettings::describe(Schema<SpatialGaussiansSettings>& s) {
  using S = SpatialGaussiansSettings;
  describe_mixture_learning(s);
  s.field("prior_counts", &S::prior_counts,
          "Samples that every component is believed to have (Dirichlet prior)")
      .above(0);
  s.field("prior_strength", &S::prior_strength,
          "Samples that the belief in a round component counts for (inverse Wishart prior); its "
          "variance is that of the cell's first samples")
      .above(0);
  s.field(
       "largest_concentration", &S::largest_concentration,
       "Largest squared ratio of a component's distance from the middle of its cell to its least "
       "standard deviation")
      .above(0);
  s.field("least_size", &S::least_size,
          "Least standard deviation, relative to the diagonal of the scene")
      .above(0);
  s.field("environment_distance", &S::environment_distance,
          "Assumed distance of the environment, relative to the diagonal of the scene")
      .above(0);
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
