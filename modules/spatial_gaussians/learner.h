#pragma once

#include <pharos/guiding/toolkit/kd_tree_learning.h>

namespace pharos::spatial_gaussians {

/// Parameters of the method. The paper states none; docs and sources are in the README.
struct SpatialGaussiansSettings {
  SpatialCells spatial = SpatialCells::kdtree;
  std::uint32_t cell_samples = 32768;
  int max_depth = 32;
  std::uint32_t batch_samples = 1u << 22;
  std::uint32_t components = 16, most_components = 32;
  std::uint32_t first_samples = 32;
  int em_iterations = 100;
  double em_tolerance = 0.005;
  double prior_counts = 0.01, prior_strength = 0.2;
  double largest_concentration = 32768;
  double least_size = 1e-5;
  double split_threshold = 0.5;
  float least_density = 0.01f;
  std::uint32_t split_samples = 4096;
  double merge_threshold = 0.025;
  std::uint32_t merge_samples = 8192;
  double decay = 1, division_decay = 0.25;
  float least_pdf = 0.1f;
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
  std::shared_ptr<const GuidingModel> load_model(std::istream& in) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::spatial_gaussians
