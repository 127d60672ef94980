#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pharos::practical_path_guiding {

/// Maximum number of nodes. A file with a larger count is damaged.
inline constexpr std::uint32_t kMostNodes = 1u << 24;

/// Returns whether the nodes' `child[4]` form a tree of at most `levels` levels: every node except
/// the first is the child of exactly one earlier node. An empty vector is allowed.
template <class Node>
bool is_quadtree(const std::vector<Node>& nodes, int levels) {
  std::vector<int> level(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0 && level[i] == 0) return false;
    for (const auto child : nodes[i].child) {
      if (child == 0) continue;
      if (child <= i || child >= nodes.size() || level[child] != 0) return false;
      level[child] = level[i] + 1;
      if (level[child] >= levels) return false;
    }
  }
  return true;
}

}  // namespace pharos::practical_path_guiding
