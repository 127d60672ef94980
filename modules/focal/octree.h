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

  void limit(const Lanes& low, const Lanes& high) {
    begin = larger(begin, low);
    end = smaller(end, high);
  }
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
    Words children{};

    bool is_leaf(unsigned c) const { return static_cast<std::int32_t>(children[c]) >= 0; }
    float density(unsigned c) const { return std::bit_cast<float>(children[c]); }
    /// The inner children as bits.
    unsigned inner_bits() const { return high_bits(children); }
    /// Densities of leaves; 0 in the lanes of inner children.
    Lanes densities() const { return positive_floats(children); }
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
  friend bool operator==(const Octree& a, const Octree& b) {
    return a.box_ == b.box_ && a.nodes_ == b.nodes_;
  }
  std::size_t size_bytes() const { return nodes_.size() * (sizeof(Node) + sizeof(Warp)); }

  /// The density at a point [1/scene unit^3], 0 outside.
  double density(Point3 p) const;
  /// The integral of density t^2 dt over `line` between distances [1/sr]: the density of directions
  /// that point to (or away from) points drawn from the tree (Rath et al. 2023, eq. 4, 6 and 7).
  double directional_density(const Line& line, double begin, double end) const;
  /// A point drawn with density() / mass() from numbers in [0, 1): hierarchical sample warping
  /// (McCool and Harwood 1997).
  Double3 sample(const Double3& u) const;

  /// Calls `visit(i, node, spans)` for every node i that `line` crosses between distances `begin`
  /// and `end`, with the stretches within its children. In no particular but always the same order.
  /// Inlined, so that sums of visitors stay in registers.
  template <class Visit>
  [[gnu::always_inline]] void traverse(const Line& line, double begin, double end,
                                       Visit&& visit) const;

 private:
  struct Steps;
  struct Front;

  static constexpr std::uint32_t kInner = 0x80000000u;

  /// Probabilities of lower halves, axis by axis: x, y given x, z given x and y.
  struct alignas(32) Warp {
    float x = 0.5f, y[2] = {0.5f, 0.5f}, z[4] = {0.5f, 0.5f, 0.5f, 0.5f};
  };

  /// Makes the root the only child of `front`.
  Steps enter(const Line& line, Front& front) const;
  /// Visits up to eight of the `pending` nodes of `front`, and takes them off. Their children go to
  /// `next`; returns those of them that are to be visited, as bits.
  template <class Visit>
  [[gnu::always_inline]] std::uint64_t cross(const Front& front, std::uint64_t& pending,
                                             const Steps& steps, const Spans& whole, Front& next,
                                             Visit& visit) const;

  Box box_;
  std::vector<Node> nodes_;
  std::vector<Warp> warps_;
  double mass_ = 0;
};

/// What the crossings of all nodes of one level have in common.
struct Octree::Steps {
  Lanes half[3];    ///< width of a child along the line, by axis [scene units]
  Lanes beyond[3];  ///< how much later the line enters each child than its node, by axis

  void scale(double factor) {
    for (int axis = 0; axis < 3; ++axis) {
      half[axis] = half[axis] * Lanes::all(factor);
      beyond[axis] = beyond[axis] * Lanes::all(factor);
    }
  }
};

/// The children of up to eight nodes that a line crosses on one level.
struct alignas(64) Octree::Front {
  double planes[3][64];        ///< where the line enters their slabs, by axis
  std::uint32_t children[64];  ///< as in nodes
  std::uint64_t pending;       ///< those that have yet to be visited
};

inline Octree::Steps Octree::enter(const Line& line, Front& front) const {
  // All crossings are computed from the planes through which the line enters the box, one for each
  // axis, and half a width further for children beyond the middle.
  Steps steps;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const double size = box_.size[axis] * line.reciprocal[axis];
    const double low = (box_.low[axis] - line.origin[axis]) * line.reciprocal[axis];
    front.planes[axis][0] = low + std::min(size, 0.0);
    steps.half[axis] = Lanes::all(0.5 * std::abs(size));
    steps.beyond[axis] = Lanes::load(kBeyond[axis][size < 0 ? 1 : 0]) * steps.half[axis];
  }
  front.children[0] = 0;
  return steps;
}

template <class Visit>
inline std::uint64_t Octree::cross(const Front& front, std::uint64_t& pending, const Steps& steps,
                                   const Spans& whole, Front& next, Visit& visit) const {
  std::uint64_t found = 0;
  for (int slot = 0; pending != 0 && slot < 64; slot += 8, pending &= pending - 1) {
    const int at = std::countr_zero(pending);
    const std::uint32_t i = front.children[at] & ~kInner;
    const Node node = nodes_[i];
    Spans spans = whole;
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes near = Lanes::all(front.planes[axis][at]) + steps.beyond[axis];
      near.store(&next.planes[axis][slot]);
      spans.limit(near, near + steps.half[axis]);
    }
    std::copy_n(node.children.begin(), 8, &next.children[slot]);
    visit(i, node, spans);
    found |= std::uint64_t{less_bits(spans.begin, spans.end) & node.inner_bits()} << slot;
  }
  return found;
}

template <class Visit>
inline void Octree::traverse(const Line& line, double begin, double end, Visit&& visit) const {
  // Level by level, as nodes of one level can be worked on at once. Where the children of a node
  // are put depends on the number of nodes before it alone, so that the processor need not wait for
  // what these hold; a mask tells which children are to be visited. More than eight nodes of a
  // level are taken in several rounds.
  Front fronts[kMostLevels + 1];
  Steps steps = enter(line, fronts[0]);
  const Spans whole{Lanes::all(begin), Lanes::all(end)};
  std::uint32_t unfinished = 0;  // levels with nodes left for another round
  int level = 0;
  for (std::uint64_t pending = 1;;) {
    const std::uint64_t found =
        cross(fronts[level], pending, steps, whole, fronts[level + 1], visit);
    if (pending != 0) [[unlikely]] {
      fronts[level].pending = pending;
      unfinished |= 1u << level;
    }
    if (found != 0) {
      pending = found;
      ++level;
      steps.scale(0.5);
    } else {
      if (unfinished == 0) return;
      const int back = std::bit_width(unfinished) - 1;
      unfinished ^= 1u << back;
      pending = fronts[back].pending;
      steps.scale(1u << (level - back));
      level = back;
    }
  }
}

}  // namespace pharos::focal
