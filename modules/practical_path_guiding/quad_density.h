#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

namespace pharos::practical_path_guiding {

/// The quarters of a square: bit 0 of their number says that x is in the upper half, bit 1 that y
/// is.
struct QuadNode {
  float density[4];        ///< mean over the quarter, relative to a uniform density [1]
  std::uint32_t child[4];  ///< the node that divides it, always further on; 0: none does
};

/// A density over the unit square that is constant over the leaves of a quadtree (the D-tree of
/// Mueller et al. 2017). The nodes belong to someone else; the first one is the root.
class QuadDensity {
 public:
  /// No leaf is further down.
  static constexpr int kMostLevels = 20;

  explicit QuadDensity(std::span<const QuadNode> nodes) : nodes_(nodes) {}

  /// At a point of [0,1)^2, relative to a uniform density; integrates to one.
  float at(Vec2 p) const;
  /// A point of [0,1)^2 by hierarchical warping from u in [0,1)^2: continuous in u within each
  /// leaf, so that good point sets stay good.
  Vec2 sample(Vec2 u) const;

 private:
  std::span<const QuadNode> nodes_;
};

void save_nodes(std::span<const QuadNode> nodes, std::ostream& out);
/// Throws InputError when it is no density or damaged.
std::vector<QuadNode> load_nodes(std::istream& in);

}  // namespace pharos::practical_path_guiding
