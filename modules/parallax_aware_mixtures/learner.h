#pragma once

#include <pharos/guiding/toolkit/mixture_learning.h>

namespace pharos::parallax_aware_mixtures {

/// Parameters of the method. The README documents them and states their sources.
struct ParallaxAwareMixturesSettings : MixtureLearningSettings {
  ParallaxAwareMixturesSettings() { first_samples = 128; }

  bool parallax = true;
  double first_kappa = 5;
  double prior_share = 0.01, prior_strength = 0.2;
  double most_kappa = 32768;
  float glossy = 0.3f;

  static void describe(Schema<ParallaxAwareMixturesSettings>& schema);
};

/// Learns the directional distribution of incident radiance as mixtures of von Mises-Fisher lobes
/// (Ruppert et al. 2020).
class ParallaxAwareMixturesLearner final : public Learner {
 public:
  using Settings = ParallaxAwareMixturesSettings;
  /// Throws InputError if a mixture begins with more lobes than it may have.
  explicit ParallaxAwareMixturesLearner(const Settings& settings);

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace pharos::parallax_aware_mixtures
