#include "learning.h"

#include "vmf_model.h"

namespace pharos::vmf {

std::shared_ptr<const GuidingModel> VmfLearning::model(
    const LearningCells<Sample, CellMixture>& cells) const {
  std::vector<VmfModel::Cell> contents;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CellMixture& cell = cells[i];
    contents.push_back({.pivot = cell.pivot(), .samples = static_cast<float>(cell.samples())});
    append_groups(cell.mixture(), cell.inverse_distances(), contents.back().groups);
  }
  return std::make_shared<VmfModel>(cells.tree(), contents, cells.origins());
}

}  // namespace pharos::vmf
