#include <cmath>

#include "octree.h"

namespace pharos::focal {
namespace {

constexpr std::size_t kMostNodes = 1u << 25;

/// Returns whether nodes are in breadth-first order, each node except the first has exactly one
/// parent, and densities are finite.
bool are_sound(const std::vector<Octree::Node>& nodes) {
  std::uint32_t next = 1;
  std::vector<int> levels(nodes.size(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (unsigned c = 0; c < 8; ++c) {
      if (nodes[i].is_leaf(c)) {
        if (!std::isfinite(nodes[i].density(c))) return false;
        continue;
      }
      const bool follows =
          nodes[i].index(c) == next && next < nodes.size() && levels[i] < Octree::kMostLevels;
      if (!follows) return false;
      levels[next++] = levels[i] + 1;
    }
  }
  return next == nodes.size();
}

}  // namespace

void OctreeNode::archive(Archive& archive) {
  for (unsigned c = 0; c < 8; ++c) {
    std::uint32_t word = children[c];
    archive(word);
    if (archive.loads()) children[c] = word;
  }
}

void Octree::archive(Archive& archive) {
  archive.heading("octree", 2);
  archive(box_.low, box_.size, nodes_);
  if (!archive.loads()) return;
  const bool has_volume = box_.size[0] > 0 && box_.size[1] > 0 && box_.size[2] > 0;
  archive.expect(has_volume && !nodes_.empty() && nodes_.size() <= kMostNodes && are_sound(nodes_),
                 "the octree of the focal model");
  *this = Octree(box_, std::move(nodes_));
}

}  // namespace pharos::focal
