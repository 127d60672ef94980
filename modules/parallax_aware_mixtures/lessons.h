#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <pharos/guiding/toolkit/kd_tree_learning.h>

#include "cell_mixture.h"

namespace pharos::parallax_aware_mixtures {

/// The part of KdTreeLearning that is specific to von Mises-Fisher mixtures: extracts samples from
/// paths, teaches cells, and makes models.
class ParallaxAwareMixturesLessons {
 public:
  using Sample = parallax_aware_mixtures::Sample;
  using Cell = CellMixture;
  static constexpr const char* kHeading = "parallax_aware_mixtures_learning";
  static constexpr std::uint32_t kVersion = 2;

  ParallaxAwareMixturesLessons(const ParallaxAwareMixturesSettings& settings,
                               const LearningContext& context)
      : settings_(settings), seed_(context.seed) {}

  const ParallaxAwareMixturesSettings& settings() const { return settings_; }
  std::uint64_t seed() const { return seed_; }
  void extract(const PathView& path, std::vector<Sample>& samples) {
    extract_samples(path, {settings_.least_pdf, settings_.glossy}, scratch_, samples);
  }
  void teach(CellMixture& cell, std::span<const Sample> samples, std::uint64_t lesson,
             std::size_t number) const {
    cell.update(samples, settings_, RandomStream(seed_, lesson, number));
  }
  std::shared_ptr<const GuidingModel> model(const KdTreeCells<Sample, CellMixture>& cells) const;

 private:
  ParallaxAwareMixturesSettings settings_;
  std::uint64_t seed_;
  PathScratch scratch_;
};

}  // namespace pharos::parallax_aware_mixtures
