#include "learner.h"

#include "lessons.h"
#include "model.h"

namespace pharos::parallax_aware_mixtures {

void ParallaxAwareMixturesSettings::describe(Schema<ParallaxAwareMixturesSettings>& s) {
  using S = ParallaxAwareMixturesSettings;
  describe_mixture_learning(s);
  s.field("parallax", &S::parallax,
          "Store the distances of lights, and turn lobes toward them from every point of a cell");
  s.field("first_kappa", &S::first_kappa, "Concentration (kappa) of the lobes before the first fit")
      .above(0)
      .at_most(1e6);
  s.field("prior_share", &S::prior_share,
          "Prior weight of each lobe, relative to the weight of all directions")
      .above(0);
  s.field("prior_strength", &S::prior_strength,
          "Prior number of samples per lobe that have no preferred direction")
      .above(0);
  s.field("most_kappa", &S::most_kappa, "Largest concentration (kappa) of a lobe")
      .at_least(1)
      .at_most(1e6);
  s.field("glossy", &S::glossy,
          "Roughness below which a surface acts as a mirror or lens: distances continue to the "
          "image behind it")
      .at_least(0)
      .at_most(1);
  s.example("{ spatial: single, parallax: false, components: 5, most_components: 12 }");
}

ParallaxAwareMixturesLearner::ParallaxAwareMixturesLearner(const Settings& settings)
    : settings_(settings) {
  settings.check();
}

LearnerTraits ParallaxAwareMixturesLearner::traits() const {
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> ParallaxAwareMixturesLearner::begin(
    const LearningContext& context) const {
  return std::make_unique<KdTreeLearning<ParallaxAwareMixturesLessons>>(
      ParallaxAwareMixturesLessons(settings_, context));
}

std::shared_ptr<GuidingModel> ParallaxAwareMixturesLearner::empty_model() const {
  return std::make_shared<ParallaxAwareMixturesModel>();
}

}  // namespace pharos::parallax_aware_mixtures
