#include "octree_file.h"

#include <cmath>

#include <pharos/core/binary_stream.h>

namespace pharos::focal {
namespace {

constexpr const char* kHeading = "octree";
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kMostNodes = 1u << 25;

void expect(bool holds) {
  if (!holds) throw InputError("the octree of the focal model is damaged");
}

/// Throws unless children follow their parents breadth-first, each once, and densities are sound.
void check_nodes(const std::vector<Octree::Node>& nodes) {
  std::uint32_t next = 1;
  std::vector<int> levels(nodes.size(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (unsigned c = 0; c < 8; ++c) {
      if (nodes[i].is_leaf(c)) {
        expect(std::isfinite(nodes[i].density(c)));
        continue;
      }
      expect(nodes[i].index(c) == next && next < nodes.size() && levels[i] < Octree::kMostLevels);
      levels[next++] = levels[i] + 1;
    }
  }
  expect(next == nodes.size());
}

}  // namespace

void save_octree(const Octree& octree, std::ostream& out) {
  save_heading(out, kHeading, kVersion);
  for (int axis = 0; axis < 3; ++axis) {
    save_number(out, octree.box().low[axis]);
    save_number(out, octree.box().size[axis]);
  }
  save_number(out, static_cast<std::uint32_t>(octree.nodes().size()));
  for (const Octree::Node& node : octree.nodes()) {
    for (unsigned c = 0; c < 8; ++c) save_number(out, std::uint32_t{node.children[c]});
  }
}

Octree load_octree(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = load_finite<double>(in);
    box.size[axis] = load_finite<double>(in);
    expect(box.size[axis] > 0);
  }
  const auto count = load_number<std::uint32_t>(in);
  expect(count > 0 && count <= kMostNodes);
  // Nodes come one by one, so that a wrong count costs no memory.
  std::vector<Octree::Node> nodes;
  while (nodes.size() < count) {
    Words& children = nodes.emplace_back().children;
    for (unsigned c = 0; c < 8; ++c) children[c] = load_number<std::uint32_t>(in);
  }
  check_nodes(nodes);
  return {box, std::move(nodes)};
}

}  // namespace pharos::focal
