#include "quad_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pharos::practical_path_guiding {
namespace {

double sum_of(const double (&masses)[4]) {
  return (masses[0] + masses[1]) + (masses[2] + masses[3]);
}

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

}  // namespace

/// Divides quarters with more than the threshold's share of `total`, from the root down.
struct QuadTree::Growth {
  /// A square of the old tree, or a part of one of its leaves.
  struct Square {
    std::uint32_t node = 0;  ///< index of the old node; 0 below the root: within an old leaf
    double mass = 0;
  };

  const QuadRefinement& rule;
  double total;
  std::vector<Node> masses = {};  ///< of the old tree; empty: there is none
  std::vector<Node> nodes = {};

  /// Returns a quarter of a square at a depth (1 for the root).
  Square quarter_of(const Square& square, int depth, int q) const {
    const bool in_leaf = masses.empty() || (square.node == 0 && depth > 1);
    if (in_leaf) return {0, square.mass / 4};
    const Node& old = masses[square.node];
    return {old.child[q], old.mass[q]};
  }

  /// Adds a node for a square at a depth (1 for the root), and its descendants. Returns its index.
  std::uint32_t grow(int depth, const Square& square) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    for (int q = 0; q < 4; ++q) {
      const Square quarter = quarter_of(square, depth, q);
      if (depth >= rule.max_depth || quarter.mass <= rule.threshold * total) continue;
      const std::uint32_t child = grow(depth + 1, quarter);
      nodes[index].child[q] = child;
    }
    return index;
  }
};

QuadTree::QuadTree(const QuadRefinement& rule) {
  Growth growth{rule, 1};
  growth.grow(1, {.mass = 1});
  nodes_ = std::move(growth.nodes);
}

QuadTree::Leaf QuadTree::leaf_at(Vec2 p) const {
  Leaf leaf{0, 0, 0};
  double x = p.x, y = p.y;
  while (true) {
    x *= 2;
    y *= 2;
    const unsigned right = x >= 1 ? 1 : 0, upper = y >= 1 ? 1 : 0;
    x -= right;
    y -= upper;
    leaf.quarter = right | upper << 1;
    ++leaf.depth;
    const std::uint32_t child = nodes_[leaf.node].child[leaf.quarter];
    if (child == 0) return leaf;
    leaf.node = child;
  }
}

void QuadTree::add(Vec2 p, double value) {
  const Leaf leaf = leaf_at(p);
  nodes_[leaf.node].mass[leaf.quarter] += value;
}

void QuadTree::spread(Vec2 p, double value) {
  const double size = std::ldexp(1.0, -leaf_at(p).depth);
  const double density = value / (size * size);
  const auto add_turned = [&](double x0, double x1, double y0) {
    // Splits the box at the seam; the second part continues at the other edge.
    y0 -= std::floor(y0);
    const double y1 = y0 + size;
    add_to(0, {0, 1, 0, 1}, {x0, x1, y0, std::min(y1, 1.0)}, density);
    if (y1 > 1) add_to(0, {0, 1, 0, 1}, {x0, x1, 0, y1 - 1}, density);
  };
  const double x0 = p.x - size / 2, x1 = p.x + size / 2, y0 = p.y - size / 2;
  add_turned(std::max(x0, 0.0), std::min(x1, 1.0), y0);
  // Parts beyond a pole continue on its other side.
  if (x0 < 0) add_turned(0, -x0, y0 + 0.5);
  if (x1 > 1) add_turned(2 - x1, 1, y0 + 0.5);
}

void QuadTree::add_to(std::uint32_t node, Rectangle square, const Rectangle& part, double density) {
  const double x = (square.x0 + square.x1) / 2, y = (square.y0 + square.y1) / 2;
  for (unsigned q = 0; q < 4; ++q) {
    const bool right = (q & 1) != 0, upper = (q & 2) != 0;
    const Rectangle quarter{right ? x : square.x0, right ? square.x1 : x, upper ? y : square.y0,
                            upper ? square.y1 : y};
    const double width = std::min(part.x1, quarter.x1) - std::max(part.x0, quarter.x0);
    const double height = std::min(part.y1, quarter.y1) - std::max(part.y0, quarter.y0);
    if (!(width > 0 && height > 0)) continue;
    const std::uint32_t child = nodes_[node].child[q];
    if (child == 0) {
      nodes_[node].mass[q] += density * width * height;
    } else {
      add_to(child, quarter, part, density);
    }
  }
}

void QuadTree::add_evenly(std::uint32_t node, double mass) {
  for (unsigned q = 0; q < 4; ++q) {
    const std::uint32_t child = nodes_[node].child[q];
    if (child == 0) {
      nodes_[node].mass[q] += mass / 4;
    } else {
      add_evenly(child, mass / 4);
    }
  }
}

void QuadTree::divide(std::uint32_t node, unsigned quarter) {
  const double part = std::exchange(nodes_[node].mass[quarter], 0) / 4;
  nodes_[node].child[quarter] = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({.mass = {part, part, part, part}});
}

void QuadTree::add(const QuadTree& other, double factor, bool is_finer) {
  const std::vector<Node> masses = other.with_masses(LeafMass::sum);
  struct Pair {
    std::uint32_t here, there;  // nodes of the same square
  };
  std::vector<Pair> undone{{0, 0}};
  while (!undone.empty()) {
    const auto [here, there] = undone.back();
    undone.pop_back();
    for (unsigned q = 0; q < 4; ++q) {
      const std::uint32_t child = masses[there].child[q];
      const double mass = factor * masses[there].mass[q];
      if (is_finer && child != 0 && nodes_[here].child[q] == 0) divide(here, q);
      const std::uint32_t own = nodes_[here].child[q];
      if (own == 0) {
        nodes_[here].mass[q] += mass;
      } else if (child == 0) {
        add_evenly(own, mass);
      } else {
        undone.push_back({own, child});
      }
    }
  }
}

QuadTree QuadTree::smoothed(double prior) const {
  QuadTree tree;
  tree.nodes_ = with_masses(LeafMass::sum);
  std::vector<double> received(nodes_.size());
  received[0] = sum_of(tree.nodes_[0].mass);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = tree.nodes_[i];
    const double sum = sum_of(node.mass) + prior;
    for (unsigned q = 0; q < 4; ++q) {
      const double share = sum > 0 ? (node.mass[q] + prior / 4) / sum : 0;
      const double mass = received[i] * share;
      if (node.child[q] == 0) {
        node.mass[q] = mass;
      } else {
        received[node.child[q]] = mass;
        node.mass[q] = 0;
      }
    }
  }
  return tree;
}

double QuadTree::total() const {
  double total = 0;
  for (const Node& node : nodes_) total += sum_of(node.mass);
  return total;
}

void QuadTree::scale(double factor) {
  for (Node& node : nodes_) {
    for (double& mass : node.mass) mass *= factor;
  }
}

std::vector<QuadTree::Node> QuadTree::with_masses(LeafMass kind) const {
  std::vector<Node> nodes = nodes_;
  std::vector<double> areas(nodes.size(), 1);  // areas of the nodes' squares [1]
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (int q = 0; q < 4; ++q) {
      const double area = areas[i] / 4;
      if (nodes[i].child[q] != 0) {
        areas[nodes[i].child[q]] = area;
      } else if (kind == LeafMass::root) {
        nodes[i].mass[q] = std::sqrt(area * nodes[i].mass[q]);
      }
    }
  }
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children are stored after their parents
    for (int q = 0; q < 4; ++q) {
      if (nodes[i].child[q] != 0) nodes[i].mass[q] = sum_of(nodes[nodes[i].child[q]].mass);
    }
  }
  return nodes;
}

std::vector<QuadNode> QuadTree::density(LeafMass kind) const {
  const std::vector<Node> masses = with_masses(kind);
  const auto share = [](double part, double whole) {
    return whole > 0 ? static_cast<float>(part / whole) : 0.5f;
  };
  std::vector<QuadNode> nodes(masses.size());
  std::vector<std::uint32_t> places{0};  // of the nodes in `masses`, level by level
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = masses[places[i]];
    const auto& m = node.mass;
    const double left = m[0] + m[2], right = m[1] + m[3];
    nodes[i] = {share(left, left + right), {share(m[0], left), share(m[1], right)}};
    const auto first = static_cast<std::uint32_t>(places.size());
    for (unsigned q = 0; q < 4; ++q) {
      if (node.child[q] == 0) continue;
      nodes[i].children |= first << 4 | 1u << q;
      places.push_back(node.child[q]);
    }
  }
  return nodes;
}

QuadTree QuadTree::refined(LeafMass kind, const QuadRefinement& rule) const {
  std::vector<Node> masses = with_masses(kind);
  const double total = sum_of(masses[0].mass);
  if (!(total > 0)) return QuadTree(rule);
  Growth growth{rule, total, std::move(masses)};
  growth.grow(1, {});
  QuadTree tree;
  tree.nodes_ = std::move(growth.nodes);
  return tree;
}

void QuadTree::archive(Archive& archive) {
  archive(nodes_);
  if (!archive.loads()) return;
  bool is_sound = !nodes_.empty() && nodes_.size() <= kMostNodes &&
                  is_quadtree(nodes_, QuadDensity::kMostLevels);
  for (const Node& node : nodes_) {
    for (const double mass : node.mass) is_sound &= mass >= 0;
  }
  archive.expect(is_sound, "the learning of the directional trees");
}

}  // namespace pharos::practical_path_guiding
