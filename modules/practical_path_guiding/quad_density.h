#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>

namespace pharos::practical_path_guiding {

/// The quarters of a square. In the number of a quarter, bit 0 is set in the upper half of x, and
/// bit 1 in the upper half of y.
struct QuadNode {
  float density[4];  ///< mean over the quarter, relative to a uniform density [1]
  /// Index of the node that divides the quarter, greater than the index of this node; 0: none.
  std::uint32_t child[4];
  void archive(Archive& archive) { archive(density, child); }
};

/// A density over the unit square that is constant over the leaves of a quadtree (the D-tree of
/// Mueller et al. 2017). The caller owns the nodes; the first one is the root.
class QuadDensity {
 public:
  /// Maximum number of levels.
  static constexpr int kMostLevels = 20;

  explicit QuadDensity(std::span<const QuadNode> nodes) : nodes_(nodes) {}

  /// Returns the density at a point of [0,1)^2, relative to a uniform density; it integrates to
  /// one.
  float at(Vec2 p) const;
  /// Samples a point of [0,1)^2 by hierarchical warping of u in [0,1)^2. The map is continuous
  /// within each leaf, so well-distributed point sets stay well distributed.
  Vec2 sample(Vec2 u) const;

 private:
  std::span<const QuadNode> nodes_;
};

/// Returns whether `nodes` is empty or is the tree of a density that integrates to one.
bool is_density(const std::vector<QuadNode>& nodes);

}  // namespace pharos::practical_path_guiding
