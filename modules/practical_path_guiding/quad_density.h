#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>

namespace pharos::practical_path_guiding {

/// Maximum number of nodes of a tree. A file with a larger count is damaged.
inline constexpr std::uint32_t kMostNodes = 1u << 24;

/// How the mass of a square is divided among its quarters. In the number of a quarter, bit 0 is set
/// in the upper half of x, and bit 1 in the upper half of y. Four nodes fill a cache line, because
/// look-ups spend most of their time waiting for nodes.
struct QuadNode {
  float left = 0.5f;              ///< share of the lower half of x
  float lower[2] = {0.5f, 0.5f};  ///< share of the lower half of y in both halves of x
  /// The lowest 4 bits state which quarters are divided. Each divided quarter has a child node. The
  /// other bits are the index of the first child; the next children follow it in the order of the
  /// quarters.
  std::uint32_t children = 0;

  bool is_divided(unsigned quarter) const { return (children >> quarter & 1) != 0; }
  /// Returns the index of the node that divides a quarter.
  std::uint32_t child(unsigned quarter) const {
    const auto before = static_cast<std::uint32_t>(std::popcount(children & ((1u << quarter) - 1)));
    return (children >> 4) + before;
  }
  /// Returns the share of a quarter in the mass of the square.
  float share(unsigned quarter) const {
    const unsigned half = quarter & 1;
    const float x = half == 0 ? left : 1 - left;
    return x * (quarter < 2 ? lower[half] : 1 - lower[half]);
  }
  void archive(Archive& archive) { archive(left, lower, children); }
};
static_assert(sizeof(QuadNode) == 16);

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

/// Returns whether `nodes` is empty or is the tree of a density, level by level from the root.
bool is_density(const std::vector<QuadNode>& nodes);

}  // namespace pharos::practical_path_guiding
