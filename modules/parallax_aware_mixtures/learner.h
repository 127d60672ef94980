#pragma once

#include <pharos/guiding/toolkit/kd_tree_learning.h>

namespace pharos::parallax_aware_mixtures {

/// Parameters of the method; docs and sources are in the README.
struct ParallaxAwareMixturesSettings {
  SpatialCells spatial = SpatialCells::kdtree;
  bool parallax = true;
  std::uint32_t cell_samples = 32768;
  int max_depth = 32;
  std::uint32_t batch_samples = 1u << 22;
  std::uint32_t components = 16, most_components = 32;
  double first_kappa = 5;
  std::uint32_t first_samples = 128;
  int em_iterations = 100;
  double em_tolerance = 0.005;
  double prior_share = 0.01, prior_strength = 0.2;
  double most_kappa = 32768;
  double split_threshold = 0.5;
  float least_density = 0.01f;
  std::uint32_t split_samples = 4096;
  double merge_threshold = 0.025;
  std::uint32_t merge_samples = 8192;
  double decay = 1, division_decay = 0.25;
  float least_pdf = 0.1f;
  float glossy = 0.3f;

  static void describe(Schema<ParallaxAwareMixturesSettings>& schema);
};

/// Learns where light comes from as mixtures of von Mises-Fisher lobes (Ruppert et al. 2020).
class ParallaxAwareMixturesLearner final : public Learner {
 public:
  using Settings = ParallaxAwareMixturesSettings;
  /// Throws InputError when there may be fewer lobes than there are at first.
  explicit ParallaxAwareMixturesLearner(const Settings& settings);

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<const GuidingModel> load_model(std::istream& in) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::parallax_aware_mixtures
