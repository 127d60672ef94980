#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>

namespace pharos {

/// A division of all space into cells by axis-aligned planes.
class KdTree {
 public:
  static constexpr int kMostLevels = 48;

  /// Returns the number of the cell that contains a point. It is below cell_count().
  std::uint32_t cell_at(Point3 p) const {
    Node node = nodes_[0];
    while (node.axis() < 3) {
      node = nodes_[node.index() + (p[static_cast<int>(node.axis())] >= node.position ? 1 : 0)];
    }
    return node.index();
  }
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(nodes_.size() + 1) / 2; }
  /// Returns the number of planes above the deepest cell.
  int depth() const;
  std::size_t size_bytes() const { return nodes_.size() * sizeof(Node); }

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

  friend bool operator==(const KdTree&, const KdTree&) = default;

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
  std::vector<Node> nodes_{Node::cell(0)};  ///< children follow their parents
};

struct KdTree::UpperPart {
  KdTree tree;
  std::vector<std::uint32_t> places;  ///< of its cells in the whole tree, ordered by cell number
};

}  // namespace pharos
