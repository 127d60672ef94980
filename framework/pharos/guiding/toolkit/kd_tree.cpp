#include <bit>
#include <cmath>
#include <span>

#include <pharos/guiding/toolkit/kd_tree.h>

namespace pharos {
namespace {

constexpr std::size_t kMostNodes = 1u << 25;
/// The grid of a smaller tree would skip few planes.
constexpr std::uint32_t kFewCells = 64;
/// Returns the number of intervals along an axis: a grid has up to 64 times as many boxes as the
/// tree has cells.
int intervals_for(std::uint32_t cells, int most) {
  const int levels = static_cast<int>(std::bit_width(cells));
  return std::min(1 << (levels + 5) / 3, most);
}

/// Returns whether the edges of a grid over the box are well apart from each other in floats.
bool can_have_grid(const Bounds3& box) {
  constexpr float kLeast = 1e-4f;  // extent relative to the coordinates
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = box.high[axis] - box.low[axis];
    const float size = std::max(std::abs(box.low[axis]), std::abs(box.high[axis]));
    if (!(extent > kLeast * size) || !(size < 1e30f) || !(extent > 1e-30f)) return false;
  }
  return true;
}

/// Sets edges[low + 1] to edges[high - 1] by halving the interval between edges[low] and
/// edges[high], and then its halves.
void halve(std::span<float> edges, std::size_t low, std::size_t high) {
  if (high - low < 2) return;
  const std::size_t middle = (low + high) / 2;
  edges[middle] = 0.5f * (edges[low] + edges[high]);
  halve(edges, low, middle);
  halve(edges, middle, high);
}

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
  grid_ = {};
  return {first, first + 1};
}

void KdTree::index(const Bounds3& box) {
  grid_ = {};
  if (cell_count() < kFewCells || !can_have_grid(box)) return;
  const Vec3 extent = box.extent();
  grid_.box = box;
  const int n = grid_.size = intervals_for(cell_count(), Grid::kMostIntervals);
  for (int axis = 0; axis < 3; ++axis) {
    grid_.scale[axis] = static_cast<float>(n) / extent[axis];
    const std::span<float> edges(grid_.edges[static_cast<std::size_t>(axis)].data(),
                                 static_cast<std::size_t>(n) + 1);
    edges.front() = box.low[axis];
    edges.back() = box.high[axis];
    halve(edges, 0, edges.size() - 1);
    edges.front() = -kInfinity;
    edges.back() = kInfinity;
  }
  grid_.entrances.resize(static_cast<std::size_t>(n) * n * n);
  enter(0, {{0, 0, 0}, {n, n, n}});
}

void KdTree::enter(std::uint32_t place, const Block& block) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (block.low[axis] >= block.high[axis]) return;
  }
  const Node node = nodes_[place];
  const auto fill = [&](const Block& part) {
    for (int z = part.low[2]; z < part.high[2]; ++z) {
      for (int y = part.low[1]; y < part.high[1]; ++y) {
        const auto row = grid_.entrances.begin() + (z * grid_.size + y) * grid_.size;
        if (part.low[0] < part.high[0]) std::fill(row + part.low[0], row + part.high[0], node);
      }
    }
  };
  const std::uint32_t axis = node.axis();
  if (axis == 3) return fill(block);
  const auto begin = grid_.edges[axis].begin(), end = begin + grid_.size + 1;
  // Intervals before `below.high` end at the plane or below it, and those from `above.low` on begin
  // at the plane or above it. `cut` has the interval between them.
  Block below = block, cut = block, above = block;
  const auto upper = static_cast<int>(std::upper_bound(begin, end, node.position) - begin) - 1;
  const auto lower = static_cast<int>(std::lower_bound(begin, end, node.position) - begin);
  below.high[axis] = std::min(block.high[axis], upper);
  above.low[axis] = std::max(block.low[axis], lower);
  cut.low[axis] = std::max(block.low[axis], below.high[axis]);
  cut.high[axis] = std::min(block.high[axis], above.low[axis]);
  fill(cut);
  enter(node.index(), below);
  enter(node.index() + 1, above);
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
  part.tree.index(grid_.box);
  return part;
}

void KdTree::archive(Archive& archive) {
  archive.heading("kd_tree", 3);
  Bounds3 box = grid_.box;
  archive(nodes_, box);
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
  index(box);
}

}  // namespace pharos
