#include "lessons.h"

#include "model.h"

namespace pharos::parallax_aware_mixtures {

std::shared_ptr<const GuidingModel> ParallaxAwareMixturesLessons::model(
    const KdTreeCells<Sample, CellMixture>& cells) const {
  std::vector<ParallaxAwareMixturesModel::Cell> contents;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CellMixture& cell = cells[i];
    contents.push_back({.pivot = cell.pivot(), .samples = static_cast<float>(cell.samples())});
    append_groups(cell.mixture(), cell.inverse_distances(), contents.back().groups);
  }
  return std::make_shared<ParallaxAwareMixturesModel>(cells.tree(), contents);
}

}  // namespace pharos::parallax_aware_mixtures
