#pragma once

#include <pharos/guiding/toolkit/mixture_learning.h>

namespace pharos::spatial_gaussians {

/// Parameters of the method. The paper states none. The README documents them and states their
/// sources.
struct SpatialGaussiansSettings : MixtureLearningSettings {
  double prior_counts = 0.01, prior_strength = 0.2;
  double largest_concentration = 32768;
  double least_size = 1e-5;
  float environment_distance = 10;

  static void describe(Schema<SpatialGaussiansSettings>& schema);
};

/// Learns mixtures of spatial Gaussians over the points from which light arrives (Lelyakin et al.
/// 2025).
class SpatialGaussiansLearner final : public Learner {
 public:
  using Settings = SpatialGaussiansSettings;
  /// Throws InputError if a mixture begins with more components than it may have.
  explicit SpatialGaussiansLearner(const Settings& settings);

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace pharos::spatial_gaussians
