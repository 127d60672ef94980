#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "lobe_mixture.h"

namespace pharos::parallax_aware_mixtures {

/// A mixture of von Mises-Fisher lobes for each cell of a kd-tree, with the places that the lobes
/// show. Regions are the cells. Cells that know nothing have no lobes.
class ParallaxAwareMixturesModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "parallax_aware_mixtures";

  /// What a cell knows.
  struct Cell {
    Point3 pivot;                   ///< where the lobes are seen from
    std::vector<LobeGroup> groups;  ///< none: nothing
    float samples = 0;              ///< that found light
    void archive(Archive& archive) { archive(pivot, groups, samples); }
  };

  ParallaxAwareMixturesModel() = default;
  /// `cells` are in the order of their numbers in the tree.
  ParallaxAwareMixturesModel(KdTree tree, const std::vector<Cell>& cells);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  Place place(const GuidingVertex& vertex) const override {
    const std::uint32_t cell = tree_.cell_at(vertex.position);
    return {cell, groups(cell).empty() ? 0.0f : std::max(samples_[cell], 1.0f)};
  }
  /// At a point alone the samples of its cell: lobes know how far away light is, but not well
  /// enough for a picture.
  double density(Point3 point, const Vec3* direction) const override;

  /// The lobes of a cell; empty: nothing known.
  std::span<const LobeGroup> groups(std::uint32_t cell) const {
    return {groups_.data() + places_[cell].first, groups_.data() + places_[cell + 1].first};
  }
  /// The way from a point to the pivot of a cell.
  Vec3 offset(std::uint32_t cell, Point3 point) const { return places_[cell].pivot - point; }

 private:
  struct CellPlace {
    Point3 pivot;
    std::uint32_t first = 0;  ///< of its groups
  };
  void add(const Cell& cell);

  KdTree tree_;
  std::vector<LobeGroup> groups_;          ///< of all cells, one after another
  std::vector<CellPlace> places_{{}, {}};  ///< of each cell, and the end
  std::vector<float> samples_{0};
};

}  // namespace pharos::parallax_aware_mixtures
