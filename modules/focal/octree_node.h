#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include <pharos/core/archive.h>

#include "quad.h"

namespace pharos::focal {

/// The eight children of a node of an octree. A child is either a leaf with a density [1/scene
/// unit^3], or an inner node with an index. The sign bit marks inner nodes, because densities are
/// never negative.
struct alignas(32) OctreeNode {
  static constexpr std::uint32_t kInner = 0x80000000u;

  Words children{};

  bool is_leaf(unsigned c) const { return static_cast<std::int32_t>(children[c]) >= 0; }
  float density(unsigned c) const { return std::bit_cast<float>(children[c]); }
  /// Returns a node with child order[c] in place of child c.
  OctreeNode mirrored(const Words& order) const { return {permuted(children, order)}; }
  /// Returns a bit mask of the inner children.
  std::uint64_t inner_bits() const { return high_bits(children); }
  /// Returns the densities of leaves, and 0 in the lanes of inner children.
  Lanes densities() const { return positive_floats(children); }
  std::uint32_t index(unsigned c) const { return children[c] & ~kInner; }
  void set_density(unsigned c, float density) {
    children[c] = std::bit_cast<std::uint32_t>(density);
  }
  void set_index(unsigned c, std::uint32_t index) { children[c] = index | kInner; }
  friend bool operator==(const OctreeNode& a, const OctreeNode& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
  void archive(Archive& archive);
};

}  // namespace pharos::focal
