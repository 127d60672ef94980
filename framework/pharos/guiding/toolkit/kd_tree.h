#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/bounds.h>

namespace pharos {

/// A division of all space into cells by axis-aligned planes.
class KdTree {
 public:
  static constexpr int kMostLevels = 48;

  /// Returns the number of the cell that contains a point. It is below cell_count().
  std::uint32_t cell_at(Point3 p) const {
    Node node = grid_.entrances.empty() ? nodes_[0] : grid_.entrance(p);
    const float coordinates[] = {p.x, p.y, p.z};  // Vec3 would select a component by branches
    while (node.axis() < 3) {
      node = nodes_[node.index() + (coordinates[node.axis()] >= node.position ? 1 : 0)];
    }
    return node.index();
  }
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(nodes_.size() + 1) / 2; }
  /// Returns the number of planes above the deepest cell.
  int depth() const;
  std::size_t size_bytes() const { return (nodes_.size() + grid_.entrances.size()) * sizeof(Node); }

  /// Makes cell_at() faster until the next division: a regular grid over `box` lets it skip the
  /// upper planes. All points keep their cells, also outside of the box. Planes that halve the box,
  /// its halves and so on are skipped best. Trees of few cells and boxes without a volume get no
  /// grid.
  void index(const Bounds3& box);

  /// Divides a cell by a plane across `axis` at `position`. The part below the plane keeps the
  /// cell's number, and the other part becomes the cell with the next free number. `leaf` is the
  /// place of the cell according to leaves().
  struct Halves {
    std::uint32_t low, high;  ///< places of both parts
  };
  Halves divide(std::uint32_t leaf, int axis, float position);
  /// Returns the places of all cells, ordered by cell number.
  std::vector<std::uint32_t> leaves() const;
  /// Returns the number of planes above the node at each place.
  std::vector<int> levels() const;
  /// Returns the place of the parent of the node at each place, which is a lower number. The root
  /// has the place 0 and is its own parent.
  std::vector<std::uint32_t> parents() const;

  /// Returns a copy of the tree that lacks the planes at the places for which `keeps` is false, and
  /// all planes below them. `keeps` has an entry for each place.
  struct UpperPart;
  UpperPart upper_part(const std::vector<bool>& keeps) const;

  void archive(Archive& archive);

  friend bool operator==(const KdTree& a, const KdTree& b) { return a.nodes_ == b.nodes_; }

 private:
  /// A plane across an axis with two child nodes, or a cell (axis 3).
  struct Node {
    std::uint32_t axis() const { return word & 3; }
    std::uint32_t index() const { return word >> 2; }
    static Node cell(std::uint32_t number) { return {number << 2 | 3, 0}; }

    /// The lowest 2 bits are the axis. The other bits are the index of the first child or the
    /// number of the cell.
    std::uint32_t word = 0;
    float position = 0;
    void archive(Archive& archive) { archive(word, position); }
    friend bool operator==(const Node&, const Node&) = default;
  };
  /// A regular grid. A look-up begins at the entrance of the box that contains the point.
  struct Grid {
    static constexpr int kMostIntervals = 32;

    Bounds3 box;
    int size = 0;  ///< number of intervals along each axis
    Vec3 scale;    ///< intervals per scene unit
    /// Ends of the intervals along each axis. The first and the last one are infinite.
    std::array<std::array<float, kMostIntervals + 1>, 3> edges;
    /// For each box, x fastest: the deepest node whose region contains it.
    std::vector<Node> entrances;

    Node entrance(Point3 p) const {
      int place = 0;
      for (int axis = 2; axis >= 0; --axis) {
        const float guess = (p[axis] - box.low[axis]) * scale[axis];
        int i = static_cast<int>(std::min(std::max(0.0f, guess), static_cast<float>(size - 1)));
        // The guess may be rounded to a neighbor.
        const float* const ends =
            &edges[static_cast<std::size_t>(axis)][static_cast<std::size_t>(i)];
        i += (p[axis] >= ends[1] ? 1 : 0) - (p[axis] < ends[0] ? 1 : 0);
        // Plus infinity is not below the last end.
        place = place * size + std::min(i, size - 1);
      }
      return entrances[static_cast<std::size_t>(place)];
    }
  };
  /// Boxes of the grid: from the interval `low` up to `high`, which is excluded, along each axis.
  struct Block {
    std::array<int, 3> low, high;
  };
  /// Sets the entrances of the boxes of a block, which lies in the region of the node at a place.
  void enter(std::uint32_t place, const Block& block);

  std::vector<Node> nodes_{Node::cell(0)};  ///< children follow their parents
  Grid grid_;
};

struct KdTree::UpperPart {
  KdTree tree;
  std::vector<std::uint32_t> places;  ///< of its cells in the whole tree, ordered by cell number
};

}  // namespace pharos
