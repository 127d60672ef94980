#pragma once

#include <iosfwd>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/guiding/toolkit/kd_tree.h>

namespace pharos::spatial_gaussians {

/// A mixture of spatial Gaussians for each cell of a kd-tree: where the light that reaches the cell
/// comes from. Cells that know nothing have no components.
class SpatialGaussiansModel final : public GuidingModel, public SpatialMixture {
 public:
  /// What a cell knows.
  struct Cell {
    std::vector<SpatialGaussian> components;
    float samples = 0;  ///< that it has seen: how much it counts in density(point)
  };

  /// `cells` by their numbers in the tree; `origins` as for region_origins().
  SpatialGaussiansModel(KdTree tree, const std::vector<Cell>& cells,
                        std::vector<std::uint32_t> origins);
  /// What save() wrote. Throws InputError when it is something else or damaged.
  explicit SpatialGaussiansModel(std::istream& in);

  std::string name() const override { return "spatial_gaussians"; }
  std::uint32_t version() const override { return kVersion; }
  std::size_t size_bytes() const override;
  void save(std::ostream& out) const override;
  std::uint32_t region_count() const override { return tree_.cell_count(); }
  std::vector<std::uint32_t> region_origins() const override { return origins_; }
  std::vector<ModelFact> facts() const override;
  double density(Point3 point) const override;
  double density(Point3 point, Vec3 direction) const override;

  View mixture_at(const GuidingQuery& query, Arena& arena) const override;
  /// The mixture of the cell around a point.
  View mixture_at(Point3 point) const;

 private:
  static constexpr std::uint32_t kVersion = 1;

  KdTree tree_;
  std::vector<SpatialGaussian> components_;  ///< of all cells, one after another
  std::vector<std::uint32_t> first_;         ///< of each cell, and the end
  std::vector<float> samples_;
  std::vector<std::uint32_t> origins_;
};

}  // namespace pharos::spatial_gaussians
