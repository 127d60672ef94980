#include "octree.h"

namespace pharos::focal {
namespace {

/// Returns the level of each node. The root has level 0.
std::vector<unsigned> levels_of(const std::vector<Octree::Node>& nodes) {
  std::vector<unsigned> levels(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (unsigned c = 0; c < 8; ++c) {
      if (!nodes[i].is_leaf(c)) levels[nodes[i].index(c)] = levels[i] + 1;
    }
  }
  return levels;
}

}  // namespace

Box Box::child(unsigned c) const {
  Box cell;
  for (unsigned axis = 0; axis < 3; ++axis) {
    cell.size[axis] = 0.5 * size[axis];
    cell.low[axis] = low[axis] + ((c >> axis & 1) != 0 ? cell.size[axis] : 0);
  }
  return cell;
}

bool Box::contains(Point3 p) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = p[axis] - low[axis];
    if (!(offset >= 0 && offset <= size[axis])) return false;
  }
  return true;
}

Octree::Octree(const Box& box, std::vector<Node> nodes)
    : box_(box),
      nodes_(std::move(nodes)),
      mass_nodes_(nodes_),
      warp_(nodes_),
      mass_(warp_.mean_density() * box_.volume()) {
  if (box_.volume() > 0) third_per_volume_ = 1 / (3 * box_.volume());
  find_leaf_masses();
}

void Octree::find_leaf_masses() {
  const std::vector<unsigned> levels = levels_of(nodes_);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double volume = leaf_volume(levels[i]);
    for (unsigned c = 0; c < 8; ++c) {
      if (!nodes_[i].is_leaf(c)) continue;
      mass_nodes_[i].set_density(c, static_cast<float>(volume * nodes_[i].density(c)));
    }
  }
}

int Octree::depth() const {
  return static_cast<int>(levels_of(nodes_).back()) + 1;
}

double Octree::density(Point3 p) const {
  if (!box_.contains(p)) return 0;
  Box cell = box_;
  for (std::uint32_t i = 0;;) {
    unsigned c = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double middle = cell.low[axis] + 0.5 * cell.size[axis];
      c |= static_cast<unsigned>(p[static_cast<int>(axis)] >= middle) << axis;
    }
    if (nodes_[i].is_leaf(c)) return nodes_[i].density(c);
    cell = cell.child(c);
    i = nodes_[i].index(c);
  }
}

Double3 Octree::sample(const Double3& u) const {
  Double3 point = warp_.sample(u);
  for (int axis = 0; axis < 3; ++axis) point[axis] = box_.low[axis] + point[axis] * box_.size[axis];
  return point;
}

}  // namespace pharos::focal
