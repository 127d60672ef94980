#pragma once

#include <algorithm>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/radiance_estimate.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/guiding/toolkit/kd_tree.h>

namespace pharos::spatial_gaussians {

/// A mixture of spatial Gaussians for each cell of a kd-tree, over the points from which light
/// arrives in the cell. The regions are the cells. A cell without data has no components.
class SpatialGaussiansModel final : public GuidingModel,
                                    public SpatialMixture,
                                    public RadianceEstimate {
 public:
  static constexpr std::string_view kName = "spatial_gaussians";

  /// The learned data of a cell.
  struct Cell {
    std::vector<SpatialGaussian> components;
    float samples = 0;  ///< number of samples that found light; the cell's weight in density(point)
    void archive(Archive& archive) { archive(components, samples); }
  };

  SpatialGaussiansModel() = default;
  /// `cells` is in the order of the cell numbers in the tree.
  SpatialGaussiansModel(KdTree tree, const std::vector<Cell>& cells);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  Place place(const GuidingVertex& vertex) const override {
    const std::uint32_t cell = tree_.cell_at(vertex.position);
    return {cell, mixture(cell).empty() ? 0.0f : std::max(samples_[cell], 1.0f)};
  }
  double density(Point3 point, const Vec3* direction) const override;
  std::span<const SpatialGaussian> mixture_at(const GuidingQuery& query, Arena&) const override {
    return mixture(query.region);
  }
  std::span<const WhitenedGroup> whitened_at(const GuidingQuery& query) const override {
    return {whitened_.data() + first_whitened_[query.region],
            whitened_.data() + first_whitened_[query.region + 1]};
  }

  RadianceTraits radiance_traits() const override { return {.around = true}; }
  const RadianceAround* radiance_around(const GuidingQuery& query, Arena& arena) const override;

  /// Returns the mixture of a cell.
  std::span<const SpatialGaussian> mixture(std::uint32_t cell) const {
    return {components_.data() + first_[cell], components_.data() + first_[cell + 1]};
  }
  /// Returns the mixture of the cell around a point.
  std::span<const SpatialGaussian> mixture_at(Point3 point) const {
    return mixture(tree_.cell_at(point));
  }

 private:
  void add(const Cell& cell);

  KdTree tree_;
  std::vector<SpatialGaussian> components_;  ///< components of all cells, one cell after another
  std::vector<std::uint32_t> first_{0, 0};   ///< index of each cell's first component, and the end
  std::vector<WhitenedGroup> whitened_;      ///< the same components, in groups of one cell each
  std::vector<std::uint32_t> first_whitened_{0, 0};  ///< index of each cell's first group
  std::vector<float> samples_{0};
};

}  // namespace pharos::spatial_gaussians
