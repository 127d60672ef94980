#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

/// A line as a box sees it. Distances along it are in scene units, as the direction is a unit
/// vector; before the origin they are negative.
struct Line {
  Line(const Box& box, Point3 from, Vec3 direction);

  Double3 entry;    ///< where it enters the slab of the box, by axis
  Double3 width;    ///< how long it stays in there, by axis
  unsigned mirror;  ///< bit d is set where it goes down along axis d
};

/// The two halves of a line at its origin.
enum class Side { ahead, behind };

/// Stretches of a line within the eight children of a node [scene units]; a child that the line
/// misses has end < begin.
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
    unsigned inner_bits() const { return high_bits(children); }
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
  /// The integral of density t^2 dt over a side of `line`, a line through box() [1/sr]: the density
  /// of directions that point to (or, behind, away from) points drawn from the tree (Rath et al.
  /// 2023, eq. 4, 6 and 7).
  double directional_density(const Line& line, Side side) const;
  /// A point drawn with density() / mass() from numbers in [0, 1): hierarchical sample warping
  /// (McCool and Harwood 1997).
  Double3 sample(const Double3& u) const;

  /// Calls `visit(i, node, spans)` for every node i that a side of `line` (of a line through box())
  /// crosses, with the stretches within its children. Both are mirrored so that the line goes
  /// upwards along all axes: what is said of c is of child c ^ line.mirror. In no particular but
  /// always the same order. Inlined, so that sums of visitors stay in registers.
  template <Side side, class Visit>
  [[gnu::always_inline]] void traverse(const Line& line, Visit&& visit) const;

 private:
  struct Steps;
  struct Front;

  static constexpr std::uint32_t kInner = 0x80000000u;

  /// Probabilities of lower halves, axis by axis: x, y given x, z given x and y.
  struct alignas(32) Warp {
    float x = 0.5f, y[2] = {0.5f, 0.5f}, z[4] = {0.5f, 0.5f, 0.5f, 0.5f};
  };

  /// Visits up to eight of the `pending` nodes of `front`, and takes them off. Their children go to
  /// `next`; returns those of them that are to be visited, as bits.
  template <Side side, class Visit>
  [[gnu::always_inline]] std::uint64_t cross(const Front& front, std::uint64_t& pending,
                                             const Steps& steps, Front& next, Visit& visit) const;

  Box box_;
  std::vector<Node> nodes_;
  std::vector<Warp> warps_;
  double mass_ = 0;
};

/// What the crossings of all nodes of one level have in common. The children below one another
/// along z are computed together: x and y are the same for them.
struct Octree::Steps {
  explicit Steps(const Line& line);

  Quad half_x, half_y, half_z;  ///< width of a child along the line [scene units]
  Quad x, y;    ///< how much later the line enters each child's slabs than its node's
  Words order;  ///< of the children as the line meets them

  void scale(double factor) {
    for (Quad* quad : {&half_x, &half_y, &half_z, &x, &y}) *quad = *quad * Quad::all(factor);
  }
};

/// The children of up to eight nodes that a line crosses on one level.
struct alignas(64) Octree::Front {
  double x[64], y[64], z[64];  ///< where the line enters their slabs
  std::uint32_t children[64];  ///< as in nodes
  std::uint64_t pending;       ///< those that have yet to be visited
};

inline Octree::Steps::Steps(const Line& line)
    : half_x(Quad::all(0.5 * line.width[0])),
      half_y(Quad::all(0.5 * line.width[1])),
      half_z(Quad::all(0.5 * line.width[2])) {
  alignas(32) static constexpr double kUpperX[4] = {0, 1, 0, 1}, kUpperY[4] = {0, 0, 1, 1};
  x = half_x * Quad::load(kUpperX);
  y = half_y * Quad::load(kUpperY);
  for (std::uint32_t c = 0; c < 8; ++c) order[c] = c ^ line.mirror;
}

template <Side side, class Visit>
inline std::uint64_t Octree::cross(const Front& front, std::uint64_t& pending, const Steps& steps,
                                   Front& next, Visit& visit) const {
  std::uint64_t found = 0;
  for (unsigned slot = 0; pending != 0 && slot < 64; slot += 8, pending &= pending - 1) {
    const auto at = static_cast<unsigned>(std::countr_zero(pending));
    const std::uint32_t i = front.children[at] & ~kInner;
    const Node node = nodes_[i].mirrored(steps.order);
    const Quad x = Quad::all(front.x[at]) + steps.x, y = Quad::all(front.y[at]) + steps.y;
    const Quad z = Quad::all(front.z[at]), middle = z + steps.half_z;
    Quad begin = larger(x, y), end = smaller(x + steps.half_x, y + steps.half_y);
    if constexpr (side == Side::ahead) begin = larger(begin, Quad{});
    if constexpr (side == Side::behind) end = smaller(end, Quad{});
    const Spans spans{{larger(begin, z), larger(begin, middle)},
                      {smaller(end, middle), smaller(end, middle + steps.half_z)}};
    // All that a child may need, at its own place: which will be visited is not known yet.
    for (const unsigned half : {0u, 4u})
      x.store(&next.x[slot + half]), y.store(&next.y[slot + half]);
    z.store(&next.z[slot]);
    middle.store(&next.z[slot + 4]);
    std::memcpy(__builtin_assume_aligned(&next.children[slot], 32), &node.children, 32);
    visit(i, node, spans);
    const unsigned crossed = ~negative_bits(spans.end - spans.begin) & node.inner_bits();
    found |= std::uint64_t{crossed} << slot;
  }
  return found;
}

template <Side side, class Visit>
inline void Octree::traverse(const Line& line, Visit&& visit) const {
  // Level by level, as nodes of one level can be worked on at once. Where the children of a node
  // are put depends on the number of nodes before it alone, so that the processor need not wait for
  // what these hold; a mask tells which children are to be visited. More than eight nodes of a
  // level are taken in several rounds.
  Front fronts[kMostLevels + 1];
  Front* front = fronts;
  front->x[0] = line.entry[0];
  front->y[0] = line.entry[1];
  front->z[0] = line.entry[2];
  front->children[0] = 0;
  Steps steps(line);
  std::uint32_t unfinished = 0;  // levels with nodes left for another round
  for (std::uint64_t pending = 1;;) {
    const std::uint64_t found = cross<side>(*front, pending, steps, front[1], visit);
    if (pending != 0) [[unlikely]] {
      front->pending = pending;
      unfinished |= 1u << (front - fronts);
    }
    if (found != 0) {
      pending = found;
      ++front;
      steps.scale(0.5);
    } else {
      if (unfinished == 0) return;
      Front* const back = fronts + (std::bit_width(unfinished) - 1);
      unfinished ^= 1u << (back - fronts);
      pending = back->pending;
      steps.scale(1u << (front - back));
      front = back;
    }
  }
}

}  // namespace pharos::focal
