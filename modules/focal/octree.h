#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>

#include "lanes.h"

namespace pharos::focal {

/// A point or an extent in double precision: cells may be 2^-15 of the region, and their crossings
/// differ in the last digits of a float.
using Double3 = std::array<double, 3>;

/// An axis-aligned box [scene units].
struct Box {
  Double3 low{}, size{};

  double volume() const { return size[0] * size[1] * size[2]; }
  /// The child cell `c` of its eight: bit d of `c` is set in the upper half along axis d.
  Box child(unsigned c) const;
  bool contains(Point3 p) const;
  friend bool operator==(const Box&, const Box&) = default;
};

/// A line with the reciprocals that crossings need. Distances along it are in scene units, as the
/// direction is a unit vector; before the origin they are negative.
struct Line {
  Line(Point3 from, Vec3 direction);

  Double3 origin, reciprocal;
};

/// Stretches of a line within the eight children of a node [scene units]; a child that the line
/// misses has begin >= end.
struct Spans {
  Lanes begin, end;
};

/// An adaptive octree over a box with a constant density in each leaf: one half, converging or
/// diverging, of the two-signed density of focal points. Nodes stand breadth-first, two in a cache
/// line; immutable.
class Octree {
 public:
  /// Levels of nodes: leaves have edges down to 2^-kMostLevels of the box.
  static constexpr int kMostLevels = 24;

  /// The eight children of a node. A child is a leaf with a density [1/scene unit^3], or an inner
  /// node by its index, marked by the sign bit (densities have none).
  struct alignas(32) Node {
    std::array<std::uint32_t, 8> children{};

    bool is_leaf(unsigned c) const { return static_cast<std::int32_t>(children[c]) >= 0; }
    float density(unsigned c) const { return std::bit_cast<float>(children[c]); }
    /// All ones in the lanes of inner children.
    LaneMask inner_lanes() const {
      return __builtin_convertvector(std::bit_cast<WordLanes>(children), LaneMask) < 0;
    }
    /// Densities of leaves; 0 in the lanes of inner children.
    Lanes density_lanes() const {
      const auto words = std::bit_cast<WordLanes>(children);
      return __builtin_convertvector(std::bit_cast<FloatLanes>(words & ~(words >> 31)), Lanes);
    }
    std::uint32_t index(unsigned c) const { return children[c] & ~kInner; }
    void set_density(unsigned c, float density) {
      children[c] = std::bit_cast<std::uint32_t>(density);
    }
    void set_index(unsigned c, std::uint32_t index) { children[c] = index | kInner; }
    friend bool operator==(const Node&, const Node&) = default;
  };

  /// One node without density.
  Octree() : Octree(Box{}, {Node{}}) {}
  /// `nodes` breadth-first from the root on: children after their parents, at most kMostLevels.
  Octree(const Box& box, std::vector<Node> nodes);

  const Box& box() const { return box_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  /// The integral of the density over the box [1].
  double mass() const { return mass_; }
  std::size_t leaf_count() const { return nodes_.size() * 7 + 1; }
  /// Levels of leaves; the root's own children are level 1.
  int depth() const;
  std::size_t size_bytes() const { return nodes_.size() * (sizeof(Node) + sizeof(Warp)); }

  /// The density at a point [1/scene unit^3], 0 outside.
  double density(Point3 p) const;
  /// The integral of density t^2 dt over `line` between distances [1/sr]: the density of directions
  /// that point to (or away from) points drawn from the tree (Rath et al. 2023, eq. 4, 6 and 7).
  double directional_density(const Line& line, double begin, double end) const;
  /// A point drawn with density() / mass() from numbers in [0, 1): hierarchical sample warping
  /// (McCool and Harwood 1997).
  Double3 sample(const Double3& u) const;

  /// Calls `visit(i, spans)` for every node i that `line` crosses between distances `begin` and
  /// `end`, with the stretches within its children. In no particular but always the same order.
  template <class Visit>
  void traverse(const Line& line, double begin, double end, Visit&& visit) const;

 private:
  static constexpr std::uint32_t kInner = 0x80000000u;

  /// Probabilities of lower halves, axis by axis: x, y given x, z given x and y.
  struct alignas(32) Warp {
    float x = 0.5f, y[2] = {0.5f, 0.5f}, z[4] = {0.5f, 0.5f, 0.5f, 0.5f};
  };

  Box box_;
  std::vector<Node> nodes_;
  std::vector<Warp> warps_;
  double mass_ = 0;
};

template <class Visit>
void Octree::traverse(const Line& line, double begin, double end, Visit&& visit) const {
  // All crossings are computed from the planes through which the line enters: `entry` of a node,
  // one for each axis, and half a node's width further for its children beyond the middle. Which
  // children these are depends on the signs of the direction: `beyond`. A fourth number is carried
  // along, half the edge of the node relative to the box.
  Quad entry, width;
  Lanes beyond[3];
  unsigned mirror = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double low = (box_.low[axis] - line.origin[axis]) * line.reciprocal[axis];
    const double size = box_.size[axis] * line.reciprocal[axis];
    mirror |= static_cast<unsigned>(size < 0) << axis;
    beyond[axis] = size < 0 ? kLower[axis] : kUpper[axis];
    entry[axis] = low + std::min(size, 0.0);
    width[axis] = std::abs(size);
  }
  entry[3] = 0.5;
  width[3] = -0.5;
  // A line crosses at most four of a node's children: three wait on each level.
  constexpr int kMostWaiting = 3 * kMostLevels + 2;
  Quad entries[kMostWaiting] = {entry};
  std::uint32_t indices[kMostWaiting] = {0};
  for (int count = 1; count > 0;) {
    const Quad from = entries[--count];
    const Quad half = from[3] * width;
    const Node& node = nodes_[indices[count]];
    Lanes near[3], far[3];
    for (int axis = 0; axis < 3; ++axis) {
      near[axis] = from[axis] + beyond[axis] * half[axis];
      far[axis] = near[axis] + half[axis];
    }
    const Lanes first = Lanes{} + begin, last = Lanes{} + end;
    near[0] = near[0] > near[1] ? near[0] : near[1];
    near[2] = near[2] > first ? near[2] : first;
    far[0] = far[0] < far[1] ? far[0] : far[1];
    far[2] = far[2] < last ? far[2] : last;
    const Spans spans{near[0] > near[2] ? near[0] : near[2], far[0] < far[2] ? far[0] : far[2]};
    visit(indices[count], spans);
    unsigned inner = to_bits((spans.begin < spans.end) & node.inner_lanes());
    for (; inner != 0; inner &= inner - 1) {
      const auto c = static_cast<unsigned>(std::countr_zero(inner));
      entries[count] = from + kCorner[c ^ mirror] * half;
      indices[count++] = node.index(c);
    }
  }
}

}  // namespace pharos::focal
