#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <pharos/guiding/toolkit/kd_tree_learning.h>

#include "cell_mixture.h"

namespace pharos::spatial_gaussians {

/// The part of KdTreeLearning that is specific to spatial Gaussians: extracts samples from paths,
/// teaches cells, and makes models.
class SpatialGaussiansLessons {
 public:
  using Sample = spatial_gaussians::Sample;
  using Cell = CellMixture;
  static constexpr const char* kHeading = "spatial_gaussians_learning";
  static constexpr std::uint32_t kVersion = 3;

  SpatialGaussiansLessons(const SpatialGaussiansSettings& settings, const LearningContext& context);

  const SpatialGaussiansSettings& settings() const { return settings_; }
  std::uint64_t seed() const { return seed_; }
  void extract(const PathView& path, std::vector<Sample>& samples) {
    extract_samples(path, rule_, incident_, samples);
  }
  void teach(CellMixture& cell, std::span<const Sample> samples, std::uint64_t lesson,
             std::size_t number) const {
    cell.update(samples, settings_, scene_size_, RandomStream(seed_, lesson, number));
  }
  std::shared_ptr<const GuidingModel> model(const KdTreeCells<Sample, CellMixture>& cells) const;

 private:
  SpatialGaussiansSettings settings_;
  SampleRule rule_;
  double scene_size_;  ///< diagonal of the scene [scene units]
  std::uint64_t seed_;
  std::vector<Rgb> incident_;  ///< scratch
};

}  // namespace pharos::spatial_gaussians
