#include "octree_refinement.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

namespace pharos::focal {
namespace {

using Node = Octree::Node;

/// Computes values of nodes from values of leaves. The value of a node is `fold(child values)`, and
/// the value of a leaf is `leaf(i, c)`.
template <class Leaf, class Fold>
std::vector<double> fold_up(const std::vector<Node>& nodes, Leaf&& leaf, Fold&& fold) {
  std::vector<double> folded(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    std::array<double, 8> children;
    for (unsigned c = 0; c < 8; ++c) {
      children[c] = nodes[i].is_leaf(c) ? leaf(i, c) : folded[nodes[i].index(c)];
    }
    folded[i] = fold(children);
  }
  return folded;
}

double sum_of(const std::array<double, 8>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The source of a new node: a node of the old octree, or a uniform distribution of mass.
struct Source {
  std::optional<std::uint32_t> node;
  double mass = 0;
  int depth = 0;  ///< depth of its children
};

/// Makes the nodes of a refined octree in breadth-first order.
class Refinement {
 public:
  Refinement(const LearningOctree& old, const SplitRule& rule)
      : old_(old),
        rule_(rule),
        sums_(fold_up(
            old.octree.nodes(), [&](std::size_t i, unsigned c) { return old.masses[8 * i + c]; },
            sum_of)) {}

  LearningOctree run() {
    sources_ = {{0u, sums_[0], 0}};
    for (std::size_t i = 0; i < sources_.size(); ++i) add_node(sources_[i]);
    return {Octree(old_.octree.box(), std::move(nodes_)), std::move(masses_)};
  }

 private:
  void add_node(const Source source) {
    Node& node = nodes_.emplace_back();
    const double volume = std::ldexp(old_.octree.box().volume(), -3 * (source.depth + 1));
    for (unsigned c = 0; c < 8; ++c) {
      const Source child = child_of(source, c);
      const bool splits =
          source.depth < rule_.max_depth && child.mass > rule_.threshold * rule_.total_mass;
      masses_.push_back(splits ? 0 : child.mass);
      if (splits) {
        node.set_index(c, static_cast<std::uint32_t>(sources_.size()));
        sources_.push_back(child);
      } else {
        node.set_density(c, static_cast<float>(child.mass / (volume * rule_.total_mass)));
      }
    }
  }

  Source child_of(const Source& source, unsigned c) const {
    if (!source.node) return {std::nullopt, source.mass / 8, source.depth + 1};
    const std::size_t i = *source.node;
    const Node& old = old_.octree.nodes()[i];
    if (old.is_leaf(c)) return {std::nullopt, old_.masses[8 * i + c], source.depth + 1};
    return {old.index(c), sums_[old.index(c)], source.depth + 1};
  }

  const LearningOctree& old_;
  const SplitRule& rule_;
  std::vector<double> sums_;
  std::vector<Source> sources_;
  std::vector<Node> nodes_;
  std::vector<double> masses_;
};

}  // namespace

void LearningOctree::archive(Archive& archive) {
  archive(octree, masses);
  bool is_sound = masses.size() == 8 * octree.nodes().size();
  for (const double mass : masses) is_sound &= mass >= 0;
  archive.expect(is_sound, "what was learned of focal points");
}

double LearningOctree::mass() const {
  return std::accumulate(masses.begin(), masses.end(), 0.0);
}

LearningOctree uniform_octree(const Box& box, double mass) {
  Node root;
  for (unsigned c = 0; c < 8; ++c) root.set_density(c, static_cast<float>(mass / box.volume()));
  return {Octree(box, {root}), std::vector<double>(8, mass / 8)};
}

LearningOctree refined(const LearningOctree& learned, const SplitRule& rule) {
  return Refinement(learned, rule).run();
}

LearningOctree enlarged(const LearningOctree& learned) {
  const std::vector<Node>& old = learned.octree.nodes();
  Box box = learned.octree.box();
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] -= 0.5 * box.size[axis];
    box.size[axis] *= 2;
  }
  // Each child of the old root becomes the innermost cell of the new root's child that contains it.
  std::vector<Node> nodes(9);
  std::vector<double> masses(72);
  const auto shifted = [](Node node) {
    for (unsigned c = 0; c < 8; ++c) {
      if (!node.is_leaf(c)) node.set_index(c, node.index(c) + 8);
    }
    return node;
  };
  const Node root = shifted(old[0]);
  for (unsigned c = 0; c < 8; ++c) {
    nodes[0].set_index(c, 1 + c);
    nodes[1 + c].children[c ^ 7] = root.children[c];
    masses[8 * (1 + c) + (c ^ 7)] = learned.masses[c];
  }
  std::transform(old.begin() + 1, old.end(), std::back_inserter(nodes), shifted);
  masses.insert(masses.end(), learned.masses.begin() + 8, learned.masses.end());
  return {Octree(box, std::move(nodes)), std::move(masses)};
}

bool is_densest_at_boundary(const Octree& octree) {
  const std::vector<Node>& nodes = octree.nodes();
  // The faces of the box that a node touches: bit d for the lower face of axis d, bit 3 + d for the
  // upper face.
  std::vector<unsigned> touched(nodes.size(), 0x3f);
  float densest = 0;
  bool at_boundary = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (unsigned c = 0; c < 8; ++c) {
      const unsigned faces = touched[i] & ((~c & 7) | c << 3);
      if (!nodes[i].is_leaf(c)) {
        touched[nodes[i].index(c)] = faces;
      } else if (nodes[i].density(c) > densest) {
        densest = nodes[i].density(c);
        at_boundary = faces != 0;
      }
    }
  }
  return at_boundary;
}

Octree pruned(const Octree& octree, double ratio) {
  const std::vector<Node>& old = octree.nodes();
  const auto density = [&](std::size_t i, unsigned c) { return double{old[i].density(c)}; };
  const std::vector<double> means =
      fold_up(old, density, [](const std::array<double, 8>& values) { return sum_of(values) / 8; });
  const std::vector<double> peaks = fold_up(old, density, [](const std::array<double, 8>& values) {
    return *std::max_element(values.begin(), values.end());
  });
  std::vector<std::uint32_t> kept{0};
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    Node node = old[kept[i]];
    for (unsigned c = 0; c < 8; ++c) {
      if (node.is_leaf(c)) continue;
      const std::uint32_t child = node.index(c);
      if (peaks[child] <= ratio * means[child]) {
        node.set_density(c, static_cast<float>(means[child]));
      } else {
        node.set_index(c, static_cast<std::uint32_t>(kept.size()));
        kept.push_back(child);
      }
    }
    nodes.push_back(node);
  }
  return {octree.box(), std::move(nodes)};
}

}  // namespace pharos::focal
