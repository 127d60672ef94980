#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "quad_density.h"

namespace pharos::practical_path_guiding {

/// What the leaves of a quadtree are given weight by.
enum class LeafMass {
  sum,  ///< what was added to them
  /// sqrt(area times what was added): where second moments are added, the piecewise constant
  /// density of least variance (Rath et al. 2020).
  root
};

/// When a quarter of a square is divided (Mueller et al. 2017, section 3.2).
struct QuadRefinement {
  double threshold = 0.01;  ///< rho: share of all mass that a leaf may have
  int max_depth = 20;       ///< levels of quarters
};

/// A density over the unit square in the making: sums in the leaves of a quadtree.
///
/// The square is the cylindrical map of the sphere, x = (1 - cos theta) / 2 and y = phi / 2 pi:
/// beyond its y edges it goes on at the opposite one, beyond its x edges, the poles, on the same
/// side half a turn further.
class QuadTree {
 public:
  /// Refined as if all mass were spread evenly.
  explicit QuadTree(const QuadRefinement& rule);

  /// Adds to the leaf at a point of [0,1)^2.
  void add(Vec2 p, double value);
  /// Spreads evenly over a box of that leaf's size around the point.
  void spread(Vec2 p, double value);
  bool has_leaves_of(const QuadTree& other) const;
  /// Adds what another tree with the same leaves holds.
  void add(const QuadTree& other);
  /// Of all that was added.
  double total() const;

  /// The density by the leaves' masses, which must not all be zero.
  std::vector<QuadNode> density(LeafMass kind) const;
  /// An empty tree whose leaves follow those masses: quarters with more than their share are
  /// divided, others are joined.
  QuadTree refined(LeafMass kind, const QuadRefinement& rule) const;

  std::size_t node_count() const { return nodes_.size(); }

  void save(std::ostream& out) const;
  /// Throws InputError when it is something else or damaged.
  static QuadTree load(std::istream& in);

 private:
  struct Node {
    double mass[4] = {};
    std::uint32_t child[4] = {};  ///< as in QuadNode
  };
  struct Rectangle {
    double x0, x1, y0, y1;
  };
  struct Leaf {
    std::uint32_t node, quarter;
    int depth;
  };
  struct Growth;

  QuadTree() = default;
  Leaf leaf_at(Vec2 p) const;
  void add_to(std::uint32_t node, Rectangle square, const Rectangle& part, double density);
  /// The nodes with the masses of all quarters, divided ones included.
  std::vector<Node> with_masses(LeafMass kind) const;

  std::vector<Node> nodes_;
};

}  // namespace pharos::practical_path_guiding
