#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pharos::practical_path_guiding {

/// More nodes than that no tree has: a larger count is damage.
inline constexpr std::uint32_t kMostNodes = 1u << 24;

/// Whether the nodes' `child[4]` make a tree of at most `levels` levels: every node but the first
/// is the child of one that stands before it. (There may be none at all.)
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
