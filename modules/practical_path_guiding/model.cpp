#include "model.h"

#include <algorithm>

#include <fmt/format.h>

#include <pharos/core/binary_stream.h>
#include <pharos/core/warp.h>

namespace pharos::practical_path_guiding {

PracticalPathGuidingModel::PracticalPathGuidingModel(KdTree tree, const std::vector<Cell>& cells,
                                                     std::vector<std::uint32_t> origins)
    : tree_(std::move(tree)), first_{0}, origins_(std::move(origins)) {
  for (const Cell& cell : cells) {
    nodes_.insert(nodes_.end(), cell.nodes.begin(), cell.nodes.end());
    first_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    light_.push_back(cell.light);
  }
}

PracticalPathGuidingModel::PracticalPathGuidingModel(std::istream& in) : first_{0} {
  expect_heading(in, kName, kVersion);
  tree_ = KdTree::load(in);
  for (std::uint32_t cell = 0; cell < tree_.cell_count(); ++cell) {
    light_.push_back(load_finite<float>(in));
    if (light_.back() < 0) throw InputError("the SD-tree is damaged");
    const std::vector<QuadNode> nodes = load_nodes(in);
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    first_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }
}

void PracticalPathGuidingModel::save(std::ostream& out) const {
  save_heading(out, kName, kVersion);
  tree_.save(out);
  for (std::uint32_t cell = 0; cell < tree_.cell_count(); ++cell) {
    save_number(out, light_[cell]);
    save_nodes({nodes_.data() + first_[cell], nodes_.data() + first_[cell + 1]}, out);
  }
}

std::size_t PracticalPathGuidingModel::size_bytes() const {
  return tree_.size_bytes() + nodes_.size() * sizeof(QuadNode) +
         light_.size() * (sizeof(float) + 2 * sizeof(std::uint32_t));
}

std::vector<ModelFact> PracticalPathGuidingModel::facts() const {
  std::size_t known = 0, most = 0;
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    const std::size_t count = first_[cell + 1] - first_[cell];
    known += count > 0 ? 1 : 0;
    most = std::max(most, count);
  }
  return {{"cells", fmt::format("{}, {} levels of planes, {} know something", tree_.cell_count(),
                                tree_.depth(), known)},
          {"directional nodes", fmt::format("{}, {} in one cell at most", nodes_.size(), most)}};
}

double PracticalPathGuidingModel::density(Point3 point) const {
  return light_[tree_.cell_at(point)];
}

double PracticalPathGuidingModel::density(Point3 point, Vec3 direction) const {
  const View view = at(point);
  if (view.nodes.empty()) return 0;
  return QuadDensity(view.nodes).at(warp::square_from_sphere(direction)) * warp::sphere_pdf();
}

}  // namespace pharos::practical_path_guiding
