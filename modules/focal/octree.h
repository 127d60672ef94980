#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>

#include "octree_node.h"
#include "octree_warp.h"
#include "quad.h"

namespace pharos::focal {

/// A point or an extent in double precision. Cells may have an edge of 2^-15 of the region, and
/// the distances to their faces differ only in the last digits of a float.
using Double3 = std::array<double, 3>;

/// An axis-aligned box [scene units].
struct Box {
  Double3 low{}, size{};

  double volume() const { return size[0] * size[1] * size[2]; }
  /// Returns child cell `c` of the eight children. Bit d of `c` is set if the child is the upper
  /// half along axis d.
  Box child(unsigned c) const;
  bool contains(Point3 p) const;
  friend bool operator==(const Box&, const Box&) = default;
};

/// A line relative to a box. Distances along the line are in scene units, because the direction is
/// a unit vector. Distances before the origin are negative.
struct Line {
  Line(const Box& box, Point3 from, Vec3 direction);

  Double3 entry;    ///< distance at which the line enters the slab of the box, by axis
  Double3 width;    ///< length of the line within the slab, by axis
  unsigned mirror;  ///< bit d is set if the line goes downward along axis d
};

inline Line::Line(const Box& box, Point3 from, Vec3 direction) {
  // If a component of the direction is zero, the line crosses the planes of this axis only at
  // distances that do not matter. If the line lies within a plane between cells, the side ahead of
  // the origin belongs to the upper cell and the side behind the origin belongs to the lower cell.
  // Neither side belongs to both.
  constexpr double kParallel = 1e60;
  mirror = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double reciprocal = direction[axis] != 0 ? 1.0 / direction[axis] : kParallel;
    const double size = box.size[axis] * reciprocal;
    const double low = (box.low[axis] - from[axis]) * reciprocal;
    entry[axis] = low + std::min(size, 0.0);
    width[axis] = std::abs(size);
    mirror |= (size < 0 ? 1u : 0u) << axis;
  }
}

/// The two halves of a line at its origin.
enum class Side { ahead, behind };

/// The intervals of a line within the eight children of a node [Octree::unit() of the node's
/// level]. If the line misses a child, the child has end < begin.
struct Spans {
  Lanes begin, end;

  /// Returns the lengths of the intervals, at least 0.
  Lanes lengths() const {
    const Lanes signed_lengths = end - begin;
    return {larger(signed_lengths.lower, Quad{}), larger(signed_lengths.upper, Quad{})};
  }
};

/// An adaptive octree over a box with a constant density in each leaf. It is one half, converging
/// or diverging, of the density of focal points. Nodes are stored in breadth-first order, two per
/// cache line. Immutable.
class Octree {
 public:
  /// Maximum number of levels of nodes. Leaves have edges down to 2^-kMostLevels of the box.
  static constexpr int kMostLevels = 24;

  using Node = OctreeNode;

  /// A node as traverse() passes it to visitors: its children are mirrored so that
  /// the line goes upward along all axes, and leaves have masses [1] instead of densities.
  struct CrossedNode {
    Node node;

    /// Returns 1 in the lanes of leaves, and 0 in the lanes of inner children.
    Lanes leaves() const { return ones_where_positive(node.children); }
    /// Returns the masses of leaves, and 0 in the lanes of inner children.
    Lanes masses() const { return node.densities(); }
  };

  /// Makes an octree with one node and zero density.
  Octree() : Octree(Box{}, {Node{}}) {}
  /// `nodes` is in breadth-first order from the root, with children after their parents, and has at
  /// most kMostLevels levels.
  Octree(const Box& box, std::vector<Node> nodes);

  const Box& box() const { return box_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Returns the integral of the density over the box [1].
  double mass() const { return mass_; }
  std::size_t leaf_count() const { return nodes_.size() * 7 + 1; }
  /// Returns the number of levels of leaves. The children of the root are level 1.
  int depth() const;
  friend bool operator==(const Octree& a, const Octree& b) {
    return a.box_ == b.box_ && a.nodes_ == b.nodes_;
  }
  std::size_t size_bytes() const { return nodes_.size() * 2 * sizeof(Node) + warp_.size_bytes(); }
  /// Saves or loads the octree. Throws InputError if the loaded data is not an octree.
  void archive(Archive& archive);

  /// Returns the density at a point [1/scene unit^3], 0 outside the box.
  double density(Point3 p) const;
  /// Samples a point with the density density() / mass() from random numbers in [0, 1).
  Double3 sample(const Double3& u) const;

  /// Calls `visit(i, node, spans, level)` for every node i that a side of `line` crosses (a line
  /// relative to box()). `spans` holds the intervals of the line within the node's children.
  /// Lengths are in units of unit(level) scene units, so the steps along the line are the same on
  /// all levels. Node and spans are mirrored so that the line goes upward along all axes: entry c
  /// belongs to child c ^ line.mirror. The order of the calls is arbitrary but always the same. The
  /// function is inlined, so the sums of visitors stay in registers.
  template <Side side, class Visit>
  [[gnu::always_inline]] void traverse(const Line& line, Visit&& visit) const;
  /// The unit in which traverse() measures lengths at nodes of a level [scene units]. The root has
  /// level 0.
  static constexpr double unit(unsigned level) { return 0.5 / static_cast<double>(1u << level); }

 private:
  struct Steps;
  struct Front;
  template <Side side>
  class Traversal;
  template <Side side>
  friend class DirectionalDensity;

  /// Visits the `crossed` nodes of `front`, at most kRound nodes. Writes their children to `next`
  /// and returns a bit mask of the children that remain to be visited.
  template <Side side, class Visit>
  [[gnu::always_inline]] std::uint64_t cross(const Front& front, std::uint64_t crossed,
                                             const Steps& steps, Front& next, Visit& visit) const;

  void find_leaf_masses();
  /// Returns the volume of a leaf whose parent is a node of this level [scene unit^3].
  double leaf_volume(unsigned level) const {
    return box_.volume() * unit(level) * unit(level) * unit(level);
  }

  Box box_;
  std::vector<Node> nodes_;
  std::vector<Node> mass_nodes_;  ///< nodes_ with masses of leaves instead of densities
  OctreeWarp warp_;
  double mass_ = 0;
  double third_per_volume_ = 0;  ///< 1 / (3 box volume); 0 for an empty box [1/scene unit^3]
};

/// The steps that the intersections of all nodes have in common [units of the node's level]. Two
/// children that are neighbors along z share their steps in x and y and are computed together.
struct Octree::Steps {
  explicit Steps(const Line& line);

  Quad begin_x, begin_y, middle_z;  ///< distance from node entry to child entry, by axis
  Quad end_x, end_y, end_z;         ///< distance from node entry to child exit, by axis
  Words order;                      ///< mirrored indices of the children
};

/// The children of up to kRound nodes that a line crosses on one level [units of this level].
struct alignas(64) Octree::Front {
  static constexpr int kRound = 8;

  double x[8 * kRound], y[8 * kRound], z[8 * kRound];  ///< line's entry into the slabs, by axis
  std::uint32_t children[8 * kRound];  ///< densities or indices of the children, as in nodes
  std::uint64_t pending;               ///< bit mask of the children that remain to be visited

  /// Removes the first kRound of the pending children and returns them.
  static std::uint64_t take_round(std::uint64_t& pending) {
    std::uint64_t round = std::exchange(pending, 0);
    if (std::popcount(round) > kRound) [[unlikely]] {
      pending = round;
      for (int k = 0; k < kRound; ++k) pending &= pending - 1;
      round ^= pending;
    }
    return round;
  }
};

inline Octree::Steps::Steps(const Line& line)
    : middle_z(Quad::all(line.width[2])), end_z(Quad::all(2 * line.width[2])) {
  alignas(32) static constexpr double kUpperX[4] = {0, 1, 0, 1}, kUpperY[4] = {0, 0, 1, 1};
  const Quad edge_x = Quad::all(line.width[0]), edge_y = Quad::all(line.width[1]);
  begin_x = edge_x * Quad::load(kUpperX);
  begin_y = edge_y * Quad::load(kUpperY);
  end_x = begin_x + edge_x;
  end_y = begin_y + edge_y;
  for (std::uint32_t c = 0; c < 8; ++c) order[c] = c ^ line.mirror;
}

template <Side side, class Visit>
inline std::uint64_t Octree::cross(const Front& front, std::uint64_t crossed, const Steps& steps,
                                   Front& next, Visit& visit) const {
  std::uint64_t found = 0;
#pragma GCC unroll 8
  for (unsigned slot = 0; slot < 8 * Front::kRound; slot += 8) {
    const auto at = static_cast<unsigned>(std::countr_zero(crossed));
    const std::uint32_t i = front.children[at] & ~Node::kInner;
    const CrossedNode node{mass_nodes_[i].mirrored(steps.order)};
    const Quad entry_x = Quad::broadcast(&front.x[at]), entry_y = Quad::broadcast(&front.y[at]),
               entry_z = Quad::broadcast(&front.z[at]);
    // Units are half as long as the units of the parents.
    const Quad x = twice_plus(entry_x, steps.begin_x), y = twice_plus(entry_y, steps.begin_y);
    const Quad z = entry_z + entry_z, middle = twice_plus(entry_z, steps.middle_z);
    Quad begin = larger(x, y);
    Quad end = smaller(twice_plus(entry_x, steps.end_x), twice_plus(entry_y, steps.end_y));
    if constexpr (side == Side::ahead) begin = larger(begin, Quad{});
    if constexpr (side == Side::behind) end = smaller(end, Quad{});
    const Spans spans{{larger(begin, z), larger(begin, middle)},
                      {smaller(end, middle), smaller(end, twice_plus(entry_z, steps.end_z))}};
    // Stores everything that a child may need at the child's own place, because it is not yet known
    // which children will be visited.
    for (const unsigned half : {0u, 4u})
      x.store(&next.x[slot + half]), y.store(&next.y[slot + half]);
    z.store(&next.z[slot]);
    middle.store(&next.z[slot + 4]);
    std::memcpy(__builtin_assume_aligned(&next.children[slot], 32), &node.node.children, 32);
    visit(i, node, spans);
    found |= (~negative_bits(spans.end - spans.begin) & node.node.inner_bits()) << slot;
    crossed &= crossed - 1;
    if (crossed == 0) break;
  }
  return found;
}

/// A traversal in progress. It proceeds level by level, because nodes of one level can be processed
/// at once. The place of a node's children depends only on the number of nodes before the node, so
/// the processor does not have to wait for the content of these nodes. A mask marks the children to
/// be visited. If a level has more than kRound nodes, they are processed in several rounds.
template <Side side>
class Octree::Traversal {
 public:
  Traversal(const Octree& octree, const Line& line) : octree_(octree), steps_(line) {
    front_->x[0] = line.entry[0];
    front_->y[0] = line.entry[1];
    front_->z[0] = line.entry[2];
    front_->children[0] = 0;
  }

  /// Visits the nodes of one round as traverse() does. Returns whether nodes remain.
  template <class Visit>
  [[gnu::always_inline]] bool advance(Visit& visit) {
    const std::uint64_t round = Front::take_round(pending_);
    const auto level = static_cast<unsigned>(front_ - fronts_);
    const auto visit_here = [&](std::uint32_t i, const CrossedNode& node, const Spans& spans) {
      visit(i, node, spans, level);
    };
    const std::uint64_t found = octree_.cross<side>(*front_, round, steps_, front_[1], visit_here);
    if (pending_ != 0) [[unlikely]] {
      front_->pending = pending_;
      unfinished_ |= 1u << level;
    }
    if (found != 0) {
      pending_ = found;
      ++front_;
      return true;
    }
    if (unfinished_ == 0) return false;
    const int back = std::bit_width(unfinished_) - 1;
    unfinished_ ^= 1u << back;
    front_ = fronts_ + back;
    pending_ = front_->pending;
    return true;
  }

 private:
  const Octree& octree_;
  Steps steps_;
  Front fronts_[kMostLevels + 1];  // not initialized
  Front* front_ = fronts_;
  std::uint64_t pending_ = 1;     // bit mask of the nodes of *front_ that remain to be visited
  std::uint32_t unfinished_ = 0;  // levels with nodes that remain for another round
};

template <Side side, class Visit>
inline void Octree::traverse(const Line& line, Visit&& visit) const {
  Traversal<side> traversal(*this, line);
  while (traversal.advance(visit)) {
  }
}

/// The integral of density t^2 dt over a side of a line [1/sr]. This is the density of directions
/// that point toward points drawn from the octree (for the side `behind`: away from these points;
/// Rath et al. 2023, eq. 4, 6 and 7). It is computed in steps. Each step depends on the step
/// before, so the processor waits less if the caller advances several computations in turn.
template <Side side>
class DirectionalDensity {
 public:
  /// `line` is relative to the box of the octree.
  DirectionalDensity(const Octree& octree, const Line& line)
      : third_per_volume_(octree.third_per_volume_), traversal_(octree, line) {}

  /// Takes the next step. Returns whether steps remain.
  [[gnu::always_inline]] bool advance() {
    const auto visit = [this](std::uint32_t, const Octree::CrossedNode& node, const Spans& spans,
                              unsigned) {
      const Lanes lengths = spans.lengths(), masses = node.masses();
      // (t1^3 - t0^3) / (t1 - t0), without the cancellation of the difference of cubes.
      const auto squares = [](const Quad& t0, const Quad& t1) { return t0 * (t0 + t1) + t1 * t1; };
      sum_ = sum_ + masses.lower * lengths.lower * squares(spans.begin.lower, spans.end.lower);
      sum_ = sum_ + masses.upper * lengths.upper * squares(spans.begin.upper, spans.end.upper);
    };
    return traversal_.advance(visit);
  }
  /// Returns the density after the last step [1/sr].
  double value() const { return sum_.sum() * third_per_volume_; }

 private:
  double third_per_volume_;
  Octree::Traversal<side> traversal_;
  Quad sum_{};
};

}  // namespace pharos::focal
