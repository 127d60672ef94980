#include "learner.h"

#include "lessons.h"
#include "model.h"

namespace pharos::parallax_aware_mixtures {

void ParallaxAwareMixturesSettings::describe(Schema<ParallaxAwareMixturesSettings>& s) {
  using S = ParallaxAwareMixturesSettings;
  describe_mixture_learning(s);
  s.field("parallax", &S::parallax,
          "Remember how far away light is, and let lobes point there from everywhere in the cell");
  s.field("first_kappa", &S::first_kappa, "Concentration of the lobes before the first fit")
      .above(0)
      .at_most(1e6);
  s.field("prior_share", &S::prior_share,
          "What every lobe is believed to have seen, relative to all that was seen")
      .above(0);
  s.field("prior_strength", &S::prior_strength,
          "Samples without any preference that every lobe is believed to have seen besides")
      .above(0);
  s.field("most_kappa", &S::most_kappa, "Largest concentration of a lobe").at_least(1).at_most(1e6);
  s.field("glossy", &S::glossy,
          "Roughness below which a surface shows what is behind it: distances go on there")
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

std::unique_ptr<LearningState> ParallaxAwareMixturesLearner::begin(const LearningContext&) const {
  return std::make_unique<KdTreeLearning<ParallaxAwareMixturesLessons>>(
      ParallaxAwareMixturesLessons(settings_));
}

std::shared_ptr<GuidingModel> ParallaxAwareMixturesLearner::empty_model() const {
  return std::make_shared<ParallaxAwareMixturesModel>();
}

}  // namespace pharos::parallax_aware_mixtures
