#include "octree.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <pharos/core/binary_stream.h>

namespace pharos::vertex_triplets {

Cube Cube::part(unsigned c) const {
  Cube half{center, 0.5f * size};
  for (int axis = 0; axis < 3; ++axis) {
    half.center[axis] += (c >> axis & 1) != 0 ? 0.25f * size : -0.25f * size;
  }
  return half;
}

int Octree::depth() const {
  float least = cubes_[0].size;
  for (const std::uint32_t node : cells_) least = std::min(least, cubes_[node].size);
  return std::ilogb(cubes_[0].size / least);
}

std::size_t Octree::size_bytes() const {
  return nodes_.size() * sizeof(Node) + cubes_.size() * sizeof(Cube) +
         cells_.size() * sizeof(std::uint32_t);
}

std::uint32_t Octree::add_parts(std::uint32_t node) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node] = Node::inner(first);
  for (unsigned c = 0; c < 8; ++c) {
    nodes_.push_back(Node::cell(0));
    cubes_.push_back(cubes_[node].part(c));
  }
  return first;
}

void Octree::make_cell(std::uint32_t node) {
  nodes_[node] = Node::cell(static_cast<std::uint32_t>(cells_.size()));
  cells_.push_back(node);
}

void Octree::collect(std::uint32_t node, std::vector<std::uint32_t>& cells) const {
  if (nodes_[node].is_cell()) {
    cells.push_back(nodes_[node].index());
    return;
  }
  for (unsigned c = 0; c < 8; ++c) collect(nodes_[node].index() + c, cells);
}

template <class ChangeOf>
void Octree::copy(std::uint32_t from, std::uint32_t to, int level, ChangeOf& change_of,
                  Octree& result, Origins& origins) const {
  const Node node = nodes_[from];
  const Change change = change_of(from, level);
  if (change == Change::divide) {
    const std::uint32_t first = result.add_parts(to);
    for (unsigned c = 0; c < 8; ++c) {
      result.make_cell(first + c);
      origins.push_back({node.index()});
    }
  } else if (change == Change::join || node.is_cell()) {
    result.make_cell(to);
    collect(from, origins.emplace_back());
  } else {
    const std::uint32_t first = result.add_parts(to);
    for (unsigned c = 0; c < 8; ++c) {
      copy(node.index() + c, first + c, level + 1, change_of, result, origins);
    }
  }
}

template <class ChangeOf>
Octree Octree::changed(ChangeOf&& change_of, Origins& origins) const {
  Octree result(cubes_[0]);
  result.cells_.clear();
  copy(0, 0, 0, change_of, result, origins);
  return result;
}

Octree::Origins Octree::collapse(std::span<const double> counts, double threshold) {
  // Parts follow their parents: one pass from the end on knows the sum of every node.
  std::vector<double> sums(nodes_.size(), 0);
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    if (nodes_[n].is_cell()) {
      sums[n] = counts[nodes_[n].index()];
    } else {
      for (unsigned c = 0; c < 8; ++c) sums[n] += sums[nodes_[n].index() + c];
    }
  }
  Origins origins;
  *this = changed(
      [&](std::uint32_t node, int) { return sums[node] < threshold ? Change::join : Change::keep; },
      origins);
  return origins;
}

Octree::Origins Octree::divide(std::span<const double> counts, double threshold) {
  Origins origins;
  *this = changed(
      [&](std::uint32_t node, int level) {
        const bool divides = nodes_[node].is_cell() && level < kMostLevels &&
                             counts[nodes_[node].index()] > threshold;
        return divides ? Change::divide : Change::keep;
      },
      origins);
  return origins;
}

void Octree::save(std::ostream& out) const {
  for (int axis = 0; axis < 3; ++axis) save_number(out, cubes_[0].center[axis]);
  save_number(out, cubes_[0].size);
  save_number(out, static_cast<std::uint32_t>(nodes_.size()));
  for (const Node node : nodes_) save_number(out, static_cast<std::uint8_t>(node.is_cell()));
}

Octree Octree::load(std::istream& in) {
  Cube cube;
  for (int axis = 0; axis < 3; ++axis) cube.center[axis] = load_finite<float>(in);
  cube.size = load_finite<float>(in);
  const auto count = load_number<std::uint32_t>(in);
  constexpr std::uint32_t kMostNodes = 1u << 26;
  if (!(cube.size > 0) || count > kMostNodes) throw InputError("the octree is damaged");
  // Nodes stand in the order in which copy() makes them: depth first, parts side by side.
  std::vector<bool> is_cell;
  for (std::uint32_t n = 0; n < count; ++n) is_cell.push_back(load_number<std::uint8_t>(in) != 0);
  Octree tree(cube);
  tree.cells_.clear();
  const std::function<void(std::uint32_t, int)> fill = [&](std::uint32_t node, int level) {
    if (node >= is_cell.size() || level > kMostLevels) throw InputError("the octree is damaged");
    if (is_cell[node]) {
      tree.make_cell(node);
      return;
    }
    const std::uint32_t first = tree.add_parts(node);
    for (unsigned c = 0; c < 8; ++c) fill(first + c, level + 1);
  };
  fill(0, 0);
  if (tree.nodes_.size() != count) throw InputError("the octree is damaged");
  return tree;
}

}  // namespace pharos::vertex_triplets
