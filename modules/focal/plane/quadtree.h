#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <pharos/core/random.h>

namespace pharos::focal::plane {

/// A point or an extent in the plane [scene units].
struct Point2 {
  double x = 0, y = 0;
};

/// An axis-aligned rectangle [scene units].
struct Cell {
  Point2 low, size;

  double area() const { return size.x * size.y; }
  /// Returns child `c` of four. Bit 0 of `c` is set for the right half, bit 1 for the upper half.
  Cell child(unsigned c) const;
};

/// The interval of a ray within a cell, as distances from the ray's origin [scene units]. It is
/// empty unless begin < end.
struct Stretch {
  double begin = 0, end = 0;
};

/// A half-line from `origin` in the direction (sin angle, cos angle).
struct Ray {
  Ray(Point2 from, double angle);
  Stretch within(const Cell& cell) const;

  Point2 origin, direction;
};

/// A density over a rectangle, constant in each leaf of an adaptive quadtree. It is the octree of
/// the focal guide with one dimension less. Immutable.
class Quadtree {
 public:
  /// One of the four children of a node. The child is a leaf if `node` is 0, because no child is
  /// the root.
  struct Child {
    std::uint32_t node = 0;
    double mass = 0;  ///< mass of all leaves below [1]
  };
  using Node = std::array<Child, 4>;
  /// Sums collected in leaves: index [4 i + c] belongs to child c of node i.
  using Sums = std::vector<double>;
  /// The rule by which leaves become nodes and nodes become leaves (section 5, "Data structure").
  struct SplitRule {
    double threshold = 1e-3;  ///< a child with a larger share of the mass becomes a node
    int max_depth = 12;       ///< maximum depth of leaves; the children of the root have depth 0
  };

  /// Makes the uniform density over `region`, refined by the same rule.
  Quadtree(const Cell& region, const SplitRule& rule);

  const Cell& region() const { return region_; }
  std::size_t leaf_count() const { return 3 * nodes_.size() + 1; }
  Sums empty_sums() const { return Sums(4 * nodes_.size()); }

  /// Returns a tree whose masses are proportional to `sums`, split by `rule`. A leaf that is split
  /// distributes its mass uniformly, over as many levels as necessary. A node below the threshold
  /// becomes a leaf with all of its mass. If all sums are zero, returns a copy of this tree.
  Quadtree refined(const Sums& sums, const SplitRule& rule) const;

  /// Samples a point. The density is the mass divided by the area of the leaf.
  Point2 sample(RandomStream& random) const;

  /// Returns the density of the directions from `ray`'s origin to points of sample() [1/rad].
  ///
  /// In polar coordinates about the origin, an area element is t dt d(angle). The density of a
  /// direction is therefore the integral of density(origin + t direction) t dt, with one power of t
  /// less than in space (eq. 4). Within a leaf of mass m and area A, the density is m / A. The ray
  /// crosses the leaf from t0 to t1, and the leaf adds m (t1^2 - t0^2) / (2 A), which replaces eq.
  /// 7.
  double directional_density(const Ray& ray) const;

  /// Returns the contribution of a leaf to directional_density() [1/rad].
  static double directional_term(const Child& leaf, const Cell& cell, const Stretch& stretch) {
    return leaf.mass * (stretch.end - stretch.begin) * (stretch.end + stretch.begin) /
           (2 * cell.area());
  }

  /// Calls visit(leaf, cell, index into sums) for every leaf.
  template <class Visit>
  void for_each_leaf(Visit&& visit) const {
    const auto always = [](const Cell&) { return true; };
    walk(0, region_, always, visit);
  }
  /// Calls visit(leaf, cell, index into sums, stretch) for every leaf that `ray` crosses.
  template <class Visit>
  void traverse(const Ray& ray, Visit&& visit) const {
    const auto crossed = [&ray](const Cell& cell) {
      const Stretch stretch = ray.within(cell);
      return stretch.begin < stretch.end;
    };
    walk(0, region_, crossed, [&](const Child& leaf, const Cell& cell, std::size_t index) {
      visit(leaf, cell, index, ray.within(cell));
    });
  }

 private:
  explicit Quadtree(const Cell& region) : region_(region) {}
  double total_below(std::uint32_t node, const Sums& sums) const;
  struct Refinement;

  /// Visits the leaves below `node` for which `enter` accepts the cell of the leaf and the cells of
  /// all nodes above it.
  template <class Enter, class Visit>
  void walk(std::uint32_t node, const Cell& cell, const Enter& enter, Visit&& visit) const {
    for (unsigned c = 0; c < 4; ++c) {
      const Child& child = nodes_[node][c];
      const Cell inner = cell.child(c);
      if (!enter(inner)) continue;
      if (child.node != 0) {
        walk(child.node, inner, enter, visit);
      } else {
        visit(child, inner, 4 * std::size_t{node} + c);
      }
    }
  }

  Cell region_;
  std::vector<Node> nodes_;
};

}  // namespace pharos::focal::plane
