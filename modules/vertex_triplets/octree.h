#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

namespace pharos::vertex_triplets {

/// A cube [scene units].
struct Cube {
  Point3 center;
  float size = 1;  ///< of an edge

  /// The part `c` of its eight: bit d of `c` is set in the upper half along axis d.
  Cube part(unsigned c) const;
  friend bool operator==(const Cube&, const Cube&) = default;
};

/// A cube divided into cubic cells, each into eight or none. What is outside belongs to the cell
/// that is nearest along the axes.
class Octree {
 public:
  static constexpr int kMostLevels = 20;

  /// One cell.
  explicit Octree(const Cube& cube) : cubes_{cube} {}

  /// The number of the cell around a point: below cell_count().
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
  /// The cube of a cell.
  const Cube& cube(std::uint32_t cell) const { return cubes_[cells_[cell]]; }
  /// Divisions above the deepest cell.
  int depth() const;
  std::size_t size_bytes() const;

  /// Of each cell the cells that it was before a change: several that became one, or one whose part
  /// it is.
  using Origins = std::vector<std::vector<std::uint32_t>>;

  /// Makes one cell of each cube whose cells' counts add up to less than `threshold`, the largest
  /// such cubes first. `counts` by cell.
  Origins collapse(std::span<const double> counts, double threshold);
  /// Divides each cell whose count is above `threshold`, once.
  Origins divide(std::span<const double> counts, double threshold);

  void save(std::ostream& out) const;
  /// Throws InputError when it is no such tree or damaged.
  static Octree load(std::istream& in);

  friend bool operator==(const Octree&, const Octree&) = default;

 private:
  /// Eight parts, by the index of the first, or a cell by its number.
  struct Node {
    bool is_cell() const { return (word & 1) != 0; }
    std::uint32_t index() const { return word >> 1; }
    static Node cell(std::uint32_t number) { return {number << 1 | 1}; }
    static Node inner(std::uint32_t first_part) { return {first_part << 1}; }
    std::uint32_t word;
    friend bool operator==(const Node&, const Node&) = default;
  };
  /// What a copy of the tree makes of a node of this one.
  enum class Change { keep, join, divide };

  /// This tree after changes; `change_of(node, level)` says which. Fills `origins`.
  template <class ChangeOf>
  Octree changed(ChangeOf&& change_of, Origins& origins) const;
  template <class ChangeOf>
  void copy(std::uint32_t from, std::uint32_t to, int level, ChangeOf& change_of, Octree& result,
            Origins& origins) const;
  /// The cells below a node.
  void collect(std::uint32_t node, std::vector<std::uint32_t>& cells) const;
  /// Makes inner nodes and cells of a node of this tree.
  std::uint32_t add_parts(std::uint32_t node);
  void make_cell(std::uint32_t node);

  std::vector<Node> nodes_{Node::cell(0)};  ///< parts follow their parents
  std::vector<Cube> cubes_;                 ///< of nodes
  std::vector<std::uint32_t> cells_{0};     ///< their nodes
};

}  // namespace pharos::vertex_triplets
