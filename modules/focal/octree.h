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

#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>

#include "quad.h"

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

/// A line as a box sees it. Distances along it are in scene units, as the direction is a unit
/// vector; before the origin they are negative.
struct Line {
  Line(const Box& box, Point3 from, Vec3 direction);

  Double3 entry;    ///< where it enters the slab of the box, by axis
  Double3 width;    ///< how long it stays in there, by axis
  unsigned mirror;  ///< bit d is set where it goes down along axis d
};

inline Line::Line(const Box& box, Point3 from, Vec3 direction) {
  // Along a zero component the line meets planes at no distance that matters. Where it lies within
  // a plane between cells, what is ahead of the origin counts to the upper cell and what is behind
  // to the lower one: never to both.
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

/// Stretches of a line within the eight children of a node [Octree::unit(level) of that]; a child
/// that the line misses has end < begin.
struct Spans {
  Lanes begin, end;

  /// At least 0.
  Lanes lengths() const {
    const Lanes signed_lengths = end - begin;
    return {larger(signed_lengths.lower, Quad{}), larger(signed_lengths.upper, Quad{})};
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
    /// With child order[c] in place of child c.
    Node mirrored(const Words& order) const { return {permuted(children, order)}; }
    /// The inner children as bits.
    std::uint64_t inner_bits() const { return high_bits(children); }
    /// Densities of leaves; 0 in the lanes of inner children.
    Lanes densities() const { return positive_floats(children); }
    std::uint32_t index(unsigned c) const { return children[c] & ~kInner; }
    void set_density(unsigned c, float density) {
      children[c] = std::bit_cast<std::uint32_t>(density);
    }
    void set_index(unsigned c, std::uint32_t index) { children[c] = index | kInner; }
    friend bool operator==(const Node& a, const Node& b) {
      return std::memcmp(&a, &b, sizeof a) == 0;
    }
  };

  /// A node as traverse() shows it: its children as the line meets them, and for leaves their
  /// masses [1] in place of densities.
  struct CrossedNode {
    Node node;

    bool is_leaf(unsigned c) const { return node.is_leaf(c); }
    float mass(unsigned c) const { return node.density(c); }
    /// 0 in the lanes of inner children.
    Lanes masses() const { return node.densities(); }
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
  std::size_t size_bytes() const { return nodes_.size() * (2 * sizeof(Node) + sizeof(Warp)); }

  /// The density at a point [1/scene unit^3], 0 outside.
  double density(Point3 p) const;
  /// The integral of density t^2 dt over a side of `line`, a line through box() [1/sr]: the density
  /// of directions that point to (or, behind, away from) points drawn from the tree (Rath et al.
  /// 2023, eq. 4, 6 and 7).
  template <Side side>
  [[gnu::always_inline]] double directional_density(const Line& line) const;
  /// A point drawn with density() / mass() from numbers in [0, 1): hierarchical sample warping
  /// (McCool and Harwood 1997).
  Double3 sample(const Double3& u) const;

  /// Calls `visit(i, node, spans, level)` for every node i that a side of `line` (of a line through
  /// box()) crosses, with the stretches within its children. Lengths are in units of unit(level)
  /// scene units, so that the steps of the line are the same on all levels. Node and spans are
  /// mirrored so that the line goes upwards along all axes: what is said of c is of child
  /// c ^ line.mirror. In no particular but always the same order. Inlined, so that sums of visitors
  /// stay in registers.
  template <Side side, class Visit>
  [[gnu::always_inline]] void traverse(const Line& line, Visit&& visit) const;
  /// What traverse() measures lengths in at nodes of a level, the root's being 0 [scene units].
  static constexpr double unit(unsigned level) { return 0.5 / static_cast<double>(1u << level); }
  /// Of a leaf that is a child of such a node [scene unit^3].
  double leaf_volume(unsigned level) const {
    return box_.volume() * unit(level) * unit(level) * unit(level);
  }

 private:
  struct Steps;
  struct Front;

  static constexpr std::uint32_t kInner = 0x80000000u;

  /// Probabilities of lower halves, axis by axis: x, y given x, z given x and y.
  struct alignas(32) Warp {
    float x = 0.5f, y[2] = {0.5f, 0.5f}, z[4] = {0.5f, 0.5f, 0.5f, 0.5f};
  };

  /// Visits the `crossed` nodes of `front`, at most kRound. Their children go to `next`; returns
  /// those of them that are to be visited, as bits.
  template <Side side, class Visit>
  [[gnu::always_inline]] std::uint64_t cross(const Front& front, std::uint64_t crossed,
                                             const Steps& steps, Front& next, Visit& visit) const;

  void find_leaf_masses();

  Box box_;
  std::vector<Node> nodes_;
  std::vector<Node> mass_nodes_;  ///< nodes_ with the masses of leaves in place of densities
  std::vector<Warp> warps_;
  double mass_ = 0;
  double third_per_volume_ = 0;  ///< of the box; 0 where that is empty [1/scene unit^3]
};

/// What the crossings of all nodes have in common [units of the node's level]. The children below
/// one another along z are computed together: x and y are the same for them.
struct Octree::Steps {
  explicit Steps(const Line& line);

  Quad begin_x, begin_y, middle_z;  ///< how much later the line enters each child than its node
  Quad end_x, end_y, end_z;         ///< and leaves each, by axis
  Words order;                      ///< of the children as the line meets them
};

/// The children of up to kRound nodes that a line crosses on one level [units of those].
struct alignas(64) Octree::Front {
  static constexpr int kRound = 8;

  double x[8 * kRound], y[8 * kRound], z[8 * kRound];  ///< where the line enters their slabs
  std::uint32_t children[8 * kRound];                  ///< as in nodes
  std::uint64_t pending;                               ///< those that have yet to be visited

  /// Takes the first kRound of the pending ones off.
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
    const std::uint32_t i = front.children[at] & ~kInner;
    const CrossedNode node{mass_nodes_[i].mirrored(steps.order)};
    const Quad entry_x = Quad::broadcast(&front.x[at]), entry_y = Quad::broadcast(&front.y[at]),
               entry_z = Quad::broadcast(&front.z[at]);
    // Units are half as long as the parents'.
    const Quad x = twice_plus(entry_x, steps.begin_x), y = twice_plus(entry_y, steps.begin_y);
    const Quad z = entry_z + entry_z, middle = twice_plus(entry_z, steps.middle_z);
    Quad begin = larger(x, y);
    Quad end = smaller(twice_plus(entry_x, steps.end_x), twice_plus(entry_y, steps.end_y));
    if constexpr (side == Side::ahead) begin = larger(begin, Quad{});
    if constexpr (side == Side::behind) end = smaller(end, Quad{});
    const Spans spans{{larger(begin, z), larger(begin, middle)},
                      {smaller(end, middle), smaller(end, twice_plus(entry_z, steps.end_z))}};
    // All that a child may need, at its own place: which will be visited is not known yet.
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

template <Side side, class Visit>
inline void Octree::traverse(const Line& line, Visit&& visit) const {
  // Level by level, as nodes of one level can be worked on at once. Where the children of a node
  // are put depends on the number of nodes before it alone, so that the processor need not wait for
  // what these hold; a mask tells which children are to be visited. More than kRound nodes of a
  // level are taken in several rounds.
  Front fronts[kMostLevels + 1];
  Front* front = fronts;
  front->x[0] = line.entry[0];
  front->y[0] = line.entry[1];
  front->z[0] = line.entry[2];
  front->children[0] = 0;
  const Steps steps(line);
  std::uint32_t unfinished = 0;  // levels with nodes left for another round
  for (std::uint64_t pending = 1;;) {
    const std::uint64_t round = Front::take_round(pending);
    const auto level = static_cast<unsigned>(front - fronts);
    const auto visit_here = [&](std::uint32_t i, const CrossedNode& node, const Spans& spans) {
      visit(i, node, spans, level);
    };
    const std::uint64_t found = cross<side>(*front, round, steps, front[1], visit_here);
    if (pending != 0) [[unlikely]] {
      front->pending = pending;
      unfinished |= 1u << level;
    }
    if (found != 0) {
      pending = found;
      ++front;
    } else {
      if (unfinished == 0) return;
      const int back = std::bit_width(unfinished) - 1;
      unfinished ^= 1u << back;
      front = fronts + back;
      pending = front->pending;
    }
  }
}

template <Side side>
inline double Octree::directional_density(const Line& line) const {
  Quad sum{};
  traverse<side>(line, [&](std::uint32_t, const CrossedNode& node, const Spans& spans, unsigned) {
    const Lanes lengths = spans.lengths(), masses = node.masses();
    // t1^3 - t0^3 over the length, without its cancellation.
    const auto squares = [](const Quad& t0, const Quad& t1) { return t0 * (t0 + t1) + t1 * t1; };
    sum = sum + masses.lower * lengths.lower * squares(spans.begin.lower, spans.end.lower);
    sum = sum + masses.upper * lengths.upper * squares(spans.begin.upper, spans.end.upper);
  });
  return sum.sum() * third_per_volume_;
}

}  // namespace pharos::focal
