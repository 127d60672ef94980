#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>

namespace pharos {

/// All of space, divided into cells by planes across its axes.
class KdTree {
 public:
  static constexpr int kMostLevels = 48;

  /// The number of the cell around a point: below cell_count().
  std::uint32_t cell_at(Point3 p) const {
    Node node = nodes_[0];
    while (node.axis() < 3) {
      node = nodes_[node.index() + (p[static_cast<int>(node.axis())] >= node.position ? 1 : 0)];
    }
    return node.index();
  }
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(nodes_.size() + 1) / 2; }
  /// Planes above the deepest cell.
  int depth() const;
  std::size_t size_bytes() const { return nodes_.size() * sizeof(Node); }

  /// Divides a cell at `position` across an axis: what is below keeps its number, the rest becomes
  /// the cell with the next free one. `leaf` is the cell's place, as leaves() says.
  struct Halves {
    std::uint32_t low, high;  ///< places of both parts
  };
  Halves divide(std::uint32_t leaf, int axis, float position);
  /// The places of all cells, by their numbers.
  std::vector<std::uint32_t> leaves() const;
  /// Planes above the cell at each place.
  std::vector<int> levels() const;

  void archive(Archive& archive);

  friend bool operator==(const KdTree&, const KdTree&) = default;

 private:
  /// A plane across an axis with two nodes behind it, or a cell (axis 3).
  struct Node {
    std::uint32_t axis() const { return word & 3; }
    std::uint32_t index() const { return word >> 2; }
    static Node cell(std::uint32_t number) { return {number << 2 | 3, 0}; }

    std::uint32_t word = 0;  ///< the axis, then the index of the first child or the cell's number
    float position = 0;
    void archive(Archive& archive) { archive(word, position); }
    friend bool operator==(const Node&, const Node&) = default;
  };
  std::vector<Node> nodes_{Node::cell(0)};  ///< children follow their parents
};

}  // namespace pharos
