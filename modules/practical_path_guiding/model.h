#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "quad_density.h"

namespace pharos::practical_path_guiding {

/// Densities over directions by place: a directional quadtree in each cell of a binary tree (the
/// SD-tree of Mueller et al. 2017). Cells that know nothing have no nodes.
class PracticalPathGuidingModel final : public GuidingModel {
 public:
  /// The kind of model. A learner and a guider that both name it go together.
  static constexpr const char* kName = "practical_path_guiding";
  static constexpr std::uint32_t kVersion = 1;

  /// What a cell knows.
  struct Cell {
    std::vector<QuadNode> nodes;  ///< of its density over directions; none: nothing
    float light = 0;              ///< mean of what its samples found; for pictures
  };

  /// `cells` by their numbers in the tree; `origins` as for region_origins().
  PracticalPathGuidingModel(KdTree tree, const std::vector<Cell>& cells,
                            std::vector<std::uint32_t> origins);
  /// What save() wrote. Throws InputError when it is something else or damaged.
  explicit PracticalPathGuidingModel(std::istream& in);

  std::string name() const override { return kName; }
  std::uint32_t version() const override { return kVersion; }
  std::size_t size_bytes() const override;
  void save(std::ostream& out) const override;
  std::uint32_t region_count() const override { return tree_.cell_count(); }
  std::vector<std::uint32_t> region_origins() const override { return origins_; }
  std::vector<ModelFact> facts() const override;
  double density(Point3 point) const override;
  double density(Point3 point, Vec3 direction) const override;

  /// The cell around a point, and its density's nodes.
  struct View {
    std::span<const QuadNode> nodes;  ///< empty: nothing known here
    std::uint32_t cell = 0;
  };
  View at(Point3 point) const {
    const std::uint32_t cell = tree_.cell_at(point);
    return {{nodes_.data() + first_[cell], nodes_.data() + first_[cell + 1]}, cell};
  }

 private:
  KdTree tree_;
  std::vector<QuadNode> nodes_;       ///< of all cells, one after another
  std::vector<std::uint32_t> first_;  ///< of each cell, and the end
  std::vector<float> light_;
  std::vector<std::uint32_t> origins_;
};

}  // namespace pharos::practical_path_guiding
