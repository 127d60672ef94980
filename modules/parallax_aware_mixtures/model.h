#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "lobe_mixture.h"

namespace pharos::parallax_aware_mixtures {

/// A mixture of von Mises-Fisher lobes for each cell of a kd-tree, with the places that the lobes
/// show. Cells that know nothing have no lobes.
class ParallaxAwareMixturesModel final : public GuidingModel {
 public:
  /// The kind of model. A learner and a guider that both name it go together.
  static constexpr const char* kName = "parallax_aware_mixtures";
  static constexpr std::uint32_t kVersion = 1;

  /// What a cell knows.
  struct Cell {
    Point3 pivot;                   ///< where the lobes are seen from
    std::vector<LobeGroup> groups;  ///< none: nothing
    float samples = 0;              ///< that it has seen; for pictures
  };

  /// `cells` by their numbers in the tree; `origins` as for region_origins().
  ParallaxAwareMixturesModel(KdTree tree, const std::vector<Cell>& cells,
                             std::vector<std::uint32_t> origins);
  /// What save() wrote. Throws InputError when it is something else or damaged.
  explicit ParallaxAwareMixturesModel(std::istream& in);

  std::string name() const override { return kName; }
  std::uint32_t version() const override { return kVersion; }
  std::size_t size_bytes() const override;
  void save(std::ostream& out) const override;
  std::uint32_t region_count() const override { return tree_.cell_count(); }
  std::vector<std::uint32_t> region_origins() const override { return origins_; }
  std::vector<ModelFact> facts() const override;
  /// Samples of a cell: lobes say how far away light is, but not well enough for a picture of it.
  double density(Point3 point) const override;
  double density(Point3 point, Vec3 direction) const override;

  /// The cell around a point.
  struct View {
    std::span<const LobeGroup> groups;  ///< empty: nothing known here
    Vec3 offset;                        ///< from the point to the pivot
    std::uint32_t cell = 0;
  };
  View at(Point3 point) const {
    const std::uint32_t cell = tree_.cell_at(point);
    return {{groups_.data() + places_[cell].first, groups_.data() + places_[cell + 1].first},
            places_[cell].pivot - point,
            cell};
  }

 private:
  struct Place {
    Point3 pivot;
    std::uint32_t first;  ///< of its groups
  };
  void add(const Cell& cell);

  KdTree tree_;
  std::vector<LobeGroup> groups_;  ///< of all cells, one after another
  std::vector<Place> places_;      ///< of each cell, and the end
  std::vector<float> samples_;
  std::vector<std::uint32_t> origins_;
};

}  // namespace pharos::parallax_aware_mixtures
