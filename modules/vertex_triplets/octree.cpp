#include "octree.h"

#include <algorithm>
#include <cmath>
#include <functional>

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
  // Parts are stored after their parents, so one pass from the end computes the sum of every node.
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

void Octree::archive(Archive& archive) {
  // copy() stores nodes depth first, with the eight parts of a node side by side. Therefore it is
  // enough to save which nodes are cells.
  Cube cube = cubes_[0];
  std::vector<std::uint8_t> is_cell;
  for (const Node node : nodes_) is_cell.push_back(node.is_cell() ? 1 : 0);
  archive(cube, is_cell);
  if (!archive.loads()) return;
  const auto expect = [&](bool holds) { archive.expect(holds, "the octree"); };
  expect(cube.size > 0);
  Octree tree(cube);
  tree.cells_.clear();
  const std::function<void(std::uint32_t, int)> fill = [&](std::uint32_t node, int level) {
    expect(node < is_cell.size() && level <= kMostLevels);
    if (is_cell[node] != 0) {
      tree.make_cell(node);
      return;
    }
    const std::uint32_t first = tree.add_parts(node);
    for (unsigned c = 0; c < 8; ++c) fill(first + c, level + 1);
  };
  fill(0, 0);
  expect(tree.nodes_.size() == is_cell.size());
  *this = std::move(tree);
}

}  // namespace pharos::vertex_triplets
