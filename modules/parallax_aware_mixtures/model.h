#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/radiance_estimate.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "lobe_mixture.h"

namespace pharos::parallax_aware_mixtures {

/// A mixture of von Mises-Fisher lobes for each cell of a kd-tree, with the distances of the lobes'
/// lights. The regions are the cells. A cell without data has no lobes.
class ParallaxAwareMixturesModel final : public GuidingModel, public RadianceEstimate {
 public:
  static constexpr std::string_view kName = "parallax_aware_mixtures";

  /// The learned data of a cell.
  struct Cell {
    Point3 pivot;                   ///< point from which the lobes are seen
    std::vector<LobeGroup> groups;  ///< the lobes; empty: nothing known
    float samples = 0;              ///< number of samples that found light
    void archive(Archive& archive) { archive(pivot, groups, samples); }
  };

  ParallaxAwareMixturesModel() = default;
  /// `cells` is in the order of the cell numbers in the tree.
  ParallaxAwareMixturesModel(KdTree tree, const std::vector<Cell>& cells);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  Place place(const GuidingVertex& vertex) const override {
    const std::uint32_t cell = tree_.cell_at(vertex.position);
    return {cell, groups(cell).empty() ? 0.0f : std::max(samples_[cell], 1.0f)};
  }
  /// If `direction` is null, returns the number of samples of the point's cell, because the
  /// distances of lobes are too inaccurate for a density of points.
  double density(Point3 point, const Vec3* direction) const override;
  RadianceTraits radiance_traits() const override { return {.around = true}; }
  const RadianceAround* radiance_around(const GuidingQuery& query, Arena& arena) const override;

  /// Returns the lobes of a cell. It returns none if nothing is known there.
  std::span<const LobeGroup> groups(std::uint32_t cell) const {
    return {groups_.data() + places_[cell].first, groups_.data() + places_[cell + 1].first};
  }
  /// Returns the vector from a point to the pivot of a cell.
  Vec3 offset(std::uint32_t cell, Point3 point) const { return places_[cell].pivot - point; }

 private:
  struct CellPlace {
    Point3 pivot;
    std::uint32_t first = 0;  ///< index of the cell's first group
  };
  void add(const Cell& cell);

  KdTree tree_;
  std::vector<LobeGroup> groups_;          ///< groups of all cells, one cell after another
  std::vector<CellPlace> places_{{}, {}};  ///< one for each cell, and the end
  std::vector<float> samples_{0};
};

}  // namespace pharos::parallax_aware_mixtures
