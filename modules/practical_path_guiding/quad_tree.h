#pragma once

#include <cstdint>
#include <vector>

#include "quad_density.h"

namespace pharos::practical_path_guiding {

/// How the mass of a leaf follows from the values that were added to it.
enum class LeafMass {
  sum,  ///< the sum of the values
  /// sqrt(area times the sum). If the values are second moments, this gives the piecewise constant
  /// density of least variance (Rath et al. 2020).
  root
};

/// The rule for dividing a quarter of a square (Mueller et al. 2017, section 3.2).
struct QuadRefinement {
  double threshold = 0.01;  ///< rho: largest share of all mass in a leaf
  int max_depth = 20;       ///< maximum number of levels
};

/// Accumulates a density over the unit square: sums in the leaves of a quadtree.
///
/// The square is the cylindrical map of the sphere, x = (1 - cos theta) / 2 and y = phi / 2 pi. A
/// box beyond a y edge continues at the opposite edge. A box beyond an x edge, a pole, continues at
/// the same edge, half a turn further in y.
class QuadTree {
 public:
  /// Makes an empty tree, refined for mass that is spread evenly.
  explicit QuadTree(const QuadRefinement& rule);

  /// Adds a value to the leaf at a point of [0,1)^2.
  void add(Vec2 p, double value);
  /// Spreads a value evenly over a box around the point that has the size of the leaf there.
  void spread(Vec2 p, double value);
  /// Returns the sum of all added values.
  double total() const;

  /// Returns the density for the masses of the leaves, which must not all be zero.
  std::vector<QuadNode> density(LeafMass kind) const;
  /// Returns an empty tree refined for these masses: quarters with more than the threshold's share
  /// are divided, others are collapsed.
  QuadTree refined(LeafMass kind, const QuadRefinement& rule) const;
  /// Adds the values of another tree, times a factor, which are spread evenly over its leaves.
  /// `is_finer` states whether leaves that are divided there are divided here, too.
  void add(const QuadTree& other, double factor, bool is_finer);
  /// Returns a tree with the same leaves and the same total, whose shares are smoother. The share
  /// of a quarter in its square is the one that it would have if `prior` were spread evenly over
  /// the quarters in addition. A value much smaller than `prior` thus leaves mass at all scales
  /// around it.
  QuadTree smoothed(double prior) const;
  /// Multiplies all added values by a factor.
  void scale(double factor);

  std::size_t node_count() const { return nodes_.size(); }

  void archive(Archive& archive);

 private:
  struct Node {
    double mass[4] = {};
    std::uint32_t child[4] = {};  ///< node that divides the quarter, with a higher index; 0: none
    void archive(Archive& archive) { archive(mass, child); }
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
  /// Divides a leaf, and spreads its mass evenly.
  void divide(std::uint32_t node, unsigned quarter);
  /// Adds a mass to the leaves below a node, in proportion to their areas.
  void add_evenly(std::uint32_t node, double mass);
  /// Returns the nodes with the masses of all quarters, including divided ones.
  std::vector<Node> with_masses(LeafMass kind) const;

  std::vector<Node> nodes_;
};

}  // namespace pharos::practical_path_guiding
