#include <algorithm>

#include <pharos/guiding/toolkit/kd_tree.h>

namespace pharos {
namespace {

constexpr std::size_t kMostNodes = 1u << 25;

}  // namespace

std::vector<int> KdTree::levels() const {
  std::vector<int> levels(nodes_.size(), 0);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].axis() == 3) continue;
    levels[nodes_[i].index()] = levels[nodes_[i].index() + 1] = levels[i] + 1;
  }
  return levels;
}

std::vector<std::uint32_t> KdTree::parents() const {
  std::vector<std::uint32_t> parents(nodes_.size(), 0);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].axis() == 3) continue;
    parents[nodes_[i].index()] = parents[nodes_[i].index() + 1] = i;
  }
  return parents;
}

int KdTree::depth() const {
  const std::vector<int> all = levels();
  return *std::max_element(all.begin(), all.end());
}

std::vector<std::uint32_t> KdTree::leaves() const {
  std::vector<std::uint32_t> places(cell_count());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].axis() == 3) places[nodes_[i].index()] = i;
  }
  return places;
}

KdTree::Halves KdTree::divide(std::uint32_t leaf, int axis, float position) {
  const std::uint32_t number = nodes_[leaf].index(), added = cell_count();
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[leaf] = {first << 2 | static_cast<std::uint32_t>(axis), position};
  nodes_.push_back(Node::cell(number));
  nodes_.push_back(Node::cell(added));
  return {first, first + 1};
}

KdTree::UpperPart KdTree::upper_part(const std::vector<bool>& keeps) const {
  struct Pair {
    std::uint32_t here, there;  ///< places of the same node in both trees
  };
  UpperPart part{.places = {0}};
  std::vector<Pair> undone{{0, 0}};
  while (!undone.empty()) {
    const auto [here, there] = undone.back();
    undone.pop_back();
    const Node node = nodes_[here];
    if (node.axis() == 3 || !keeps[here]) continue;
    const std::uint32_t low = node.index(), high = low + 1;
    part.places[part.tree.nodes_[there].index()] = low;
    part.places.push_back(high);
    const Halves halves = part.tree.divide(there, static_cast<int>(node.axis()), node.position);
    undone.push_back({high, halves.high});
    undone.push_back({low, halves.low});
  }
  return part;
}

void KdTree::archive(Archive& archive) {
  archive.heading("kd_tree", 2);
  archive(nodes_);
  if (!archive.loads()) return;
  const auto expect = [&](bool holds) { archive.expect(holds, "the kd-tree"); };
  const std::size_t count = nodes_.size();
  expect(count % 2 == 1 && count <= kMostNodes);
  // Every node except the root must be a child of one earlier node, and every cell must occur once.
  std::vector<bool> has_parent(count, false), is_cell(cell_count(), false);
  std::vector<int> levels(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Node node = nodes_[i];
    if (node.axis() == 3) {
      expect(node.index() < is_cell.size() && !is_cell[node.index()]);
      is_cell[node.index()] = true;
      continue;
    }
    for (const std::uint32_t child : {node.index(), node.index() + 1}) {
      expect(child > i && child < count && !has_parent[child] && levels[i] < kMostLevels);
      has_parent[child] = true;
      levels[child] = levels[i] + 1;
    }
  }
}

}  // namespace pharos
