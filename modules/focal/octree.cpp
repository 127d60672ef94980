#include "octree.h"

#include <cmath>

namespace pharos::focal {
namespace {

constexpr double kBelowOne = 1 - 0x1p-53;

double ratio(double part, double rest) {
  return part + rest > 0 ? part / (part + rest) : 0.5;
}

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
    : box_(box), nodes_(std::move(nodes)), mass_nodes_(nodes_), warps_(nodes_.size()) {
  // Masses of nodes, relative to the cell of the node. Children are stored after their parents.
  std::vector<double> masses(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    double m[8];
    for (unsigned c = 0; c < 8; ++c) {
      m[c] = 0.125 * (node.is_leaf(c) ? node.density(c) : masses[node.index(c)]);
    }
    Warp& warp = warps_[i];
    double column[4], slice[2];
    for (unsigned k = 0; k < 4; ++k) {
      warp.z[k] = ratio(m[k], m[k + 4]);
      column[k] = m[k] + m[k + 4];
    }
    for (unsigned k = 0; k < 2; ++k) {
      warp.y[k] = ratio(column[k], column[k + 2]);
      slice[k] = column[k] + column[k + 2];
    }
    warp.x = ratio(slice[0], slice[1]);
    masses[i] = slice[0] + slice[1];
  }
  mass_ = masses[0] * box_.volume();

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
  Double3 rest = u;
  // Selects the lower half of an axis with probability p, and rescales the random number for reuse.
  // The code uses arithmetic instead of a branch, because the branch would be unpredictable.
  const auto choose = [](double& number, double p) -> unsigned {
    const unsigned upper = number >= p ? 1 : 0;
    const double is_upper = upper;
    number = std::min((number - is_upper * p) / (p + is_upper * (1 - 2 * p)), kBelowOne);
    return upper;
  };
  double edge = 1;                        // edge of the cell, relative to the box
  std::array<std::uint32_t, 3> corner{};  // corner of the cell, in units of the cell's edge
  for (std::uint32_t i = 0;;) {
    const Warp& warp = warps_[i];
    const unsigned x = choose(rest[0], warp.x);
    const unsigned y = choose(rest[1], warp.y[x]);
    const unsigned z = choose(rest[2], warp.z[x | y << 1]);
    corner = {2 * corner[0] + x, 2 * corner[1] + y, 2 * corner[2] + z};
    edge *= 0.5;
    const unsigned c = x | y << 1 | z << 2;
    if (nodes_[i].is_leaf(c)) break;
    i = nodes_[i].index(c);
  }
  for (int axis = 0; axis < 3; ++axis) {
    rest[axis] = box_.low[axis] + (corner[axis] + rest[axis]) * edge * box_.size[axis];
  }
  return rest;
}

}  // namespace pharos::focal
