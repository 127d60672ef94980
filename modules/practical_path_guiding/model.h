#pragma once

#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/radiance_estimate.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "quad_density.h"

namespace pharos::practical_path_guiding {

/// Densities over directions by place: a directional quadtree in each cell of a binary tree (the
/// SD-tree of Mueller et al. 2017). Regions are the cells. Cells that know nothing have no nodes.
class PracticalPathGuidingModel final : public GuidingModel, public RadianceEstimate {
 public:
  static constexpr std::string_view kName = "practical_path_guiding";

  /// What a cell knows.
  struct Cell {
    std::vector<QuadNode> nodes;  ///< of its density over directions; none: nothing
    float light = 0;              ///< mean of what its records found
    float records = 0;            ///< number of records behind the density
    void archive(Archive& archive) { archive(nodes, light, records); }
  };

  PracticalPathGuidingModel() = default;
  /// `cells` are in the order of their numbers in the tree. `of_radiance`: the densities are
  /// proportional to incident radiance.
  PracticalPathGuidingModel(KdTree tree, const std::vector<Cell>& cells, bool of_radiance);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  Place place(const GuidingVertex& vertex) const override {
    const std::uint32_t cell = tree_.cell_at(vertex.position);
    return {cell, nodes(cell).empty() ? 0.0f : std::max(facts_[cell].records, 1.0f)};
  }
  double density(Point3 point, const Vec3* direction) const override;

  /// Incident radiance is known if the densities are proportional to it.
  RadianceTraits radiance_traits() const override { return {.incident = of_radiance_}; }
  float incident_radiance(Point3 point, Vec3 direction) const override;

  /// The density of a cell; empty: nothing known.
  std::span<const QuadNode> nodes(std::uint32_t cell) const {
    return {nodes_.data() + first_[cell], nodes_.data() + first_[cell + 1]};
  }

 private:
  struct CellFacts {
    float light, records;
  };
  void add(const Cell& cell);

  KdTree tree_;
  std::vector<QuadNode> nodes_;             ///< of all cells, one after another
  std::vector<std::uint32_t> first_{0, 0};  ///< of each cell, and the end
  std::vector<CellFacts> facts_{{}};
  bool of_radiance_ = true;
};

}  // namespace pharos::practical_path_guiding
