#pragma once

#include <pharos/guiding/toolkit/mixture_learning.h>

namespace pharos::spatial_gaussians {

/// Parameters of the method. The paper states none; docs and sources are in the README.
struct SpatialGaussiansSettings : MixtureLearningSettings {
  double prior_counts = 0.01, prior_strength = 0.2;
  double largest_concentration = 32768;
  double least_size = 1e-5;
  float environment_distance = 10;

  static void describe(Schema<SpatialGaussiansSettings>& schema);
};

/// Learns where the light that reaches a place comes from (Lelyakin et al. 2025).
class SpatialGaussiansLearner final : public Learner {
 public:
  using Settings = SpatialGaussiansSettings;
  /// Throws InputError when there may be fewer components than there are at first.
  explicit SpatialGaussiansLearner(const Settings& settings);

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace pharos::spatial_gaussians
