#pragma once

#include <vector>

#include "octree.h"

namespace pharos::focal {

/// An octree during learning: its cells, and the mass that each cell has collected.
struct LearningOctree {
  Octree octree;
  std::vector<double> masses;  ///< mass of child c of node i at index [8 i + c]; 0 if inner

  /// The mass of all leaves.
  double mass() const;
  void archive(Archive& archive);
};

/// The rule by which leaves become nodes and nodes become leaves (section 5, "Data structure").
struct SplitRule {
  double threshold = 1e-3;  ///< a cell with a larger share of `total_mass` becomes a node
  int max_depth = 14;       ///< maximum depth of leaves; the children of the root have depth 0
  double total_mass = 1;    ///< mass to which `threshold` and densities are relative
};

/// Returns an octree of one node with `mass` distributed uniformly over `box`.
LearningOctree uniform_octree(const Box& box, double mass);

/// Returns the same masses in cells that follow `rule`. A leaf that is split distributes its mass
/// uniformly, over as many levels as necessary. A node that falls below the threshold becomes a
/// leaf with all of its mass. Densities are masses divided by the volume and by `rule.total_mass`.
LearningOctree refined(const LearningOctree& learned, const SplitRule& rule);

/// Returns the same cells and masses within a box of twice the size about the same center.
LearningOctree enlarged(const LearningOctree& learned);

/// Returns whether the densest leaf touches the boundary of the box. In this case, the dense region
/// may continue outside.
bool is_densest_at_boundary(const Octree& octree);

/// Returns `octree` without the nodes in which no leaf is denser than `ratio` times the mean
/// density of the node (section 5, "Pruning", and fig. 6).
Octree pruned(const Octree& octree, double ratio);

}  // namespace pharos::focal
