#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>

namespace pharos::vertex_triplets {

/// A cube [scene units].
struct Cube {
  Point3 center;
  float size = 1;  ///< length of an edge

  void archive(Archive& archive) { archive(center, size); }

  /// Returns part `c` of the cube's eight parts. Bit d of `c` is set in the upper half along axis
  /// d.
  Cube part(unsigned c) const;
  friend bool operator==(const Cube&, const Cube&) = default;
};

/// A cube divided into cubic cells. Each node has eight parts or none. Points outside of the cube
/// belong to the cell that is nearest along the axes.
class Octree {
 public:
  static constexpr int kMostLevels = 20;

  /// Makes a tree of one cell.
  explicit Octree(const Cube& cube) : cubes_{cube} {}

  /// Returns the number of the cell around a point, below cell_count().
  std::uint32_t cell_at(Point3 p) const {
    const Node* node = &nodes_[0];
    Point3 center = cubes_[0].center;
    float quarter = 0.25f * cubes_[0].size;
    while (!node->is_cell()) {
      unsigned part = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = p[axis] >= center[axis];
        part |= (upper ? 1u : 0u) << axis;
        center[axis] += upper ? quarter : -quarter;
      }
      quarter *= 0.5f;
      node = &nodes_[node->index() + part];
    }
    return node->index();
  }
  std::uint32_t cell_count() const { return static_cast<std::uint32_t>(cells_.size()); }
  /// Returns the cube of a cell.
  const Cube& cube(std::uint32_t cell) const { return cubes_[cells_[cell]]; }
  /// Returns the number of divisions above the deepest cell.
  int depth() const;
  std::size_t size_bytes() const;

  /// For each cell after a change, the cells before the change from which it comes: several cells
  /// if they were joined, otherwise the one cell that it equals or is a part of.
  using Origins = std::vector<std::vector<std::uint32_t>>;

  /// Joins the cells of each cube in which the counts add up to less than `threshold`, the largest
  /// such cubes first. `counts` has one value for each cell.
  Origins collapse(std::span<const double> counts, double threshold);
  /// Divides each cell whose count is above `threshold`, once.
  Origins divide(std::span<const double> counts, double threshold);

  void archive(Archive& archive);

  friend bool operator==(const Octree&, const Octree&) = default;

 private:
  /// An inner node with the index of the first of its eight parts, or a cell with its number.
  struct Node {
    bool is_cell() const { return (word & 1) != 0; }
    std::uint32_t index() const { return word >> 1; }
    static Node cell(std::uint32_t number) { return {number << 1 | 1}; }
    static Node inner(std::uint32_t first_part) { return {first_part << 1}; }
    std::uint32_t word;
    friend bool operator==(const Node&, const Node&) = default;
  };
  /// The change of a node when the tree is copied.
  enum class Change { keep, join, divide };

  /// Returns the tree after the changes that `change_of(node, level)` returns. Fills `origins`.
  template <class ChangeOf>
  Octree changed(ChangeOf&& change_of, Origins& origins) const;
  template <class ChangeOf>
  void copy(std::uint32_t from, std::uint32_t to, int level, ChangeOf& change_of, Octree& result,
            Origins& origins) const;
  /// Appends the numbers of the cells below a node.
  void collect(std::uint32_t node, std::vector<std::uint32_t>& cells) const;
  /// Makes a node an inner node with eight new parts; returns the index of the first one.
  std::uint32_t add_parts(std::uint32_t node);
  /// Makes a node the next cell.
  void make_cell(std::uint32_t node);

  std::vector<Node> nodes_{Node::cell(0)};  ///< parts follow their parents
  std::vector<Cube> cubes_;                 ///< cube of each node
  std::vector<std::uint32_t> cells_{0};     ///< node of each cell
};

}  // namespace pharos::vertex_triplets
