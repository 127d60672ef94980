#pragma once

#include <vector>

#include "octree.h"

namespace pharos::focal {

/// An octree while it learns: its cells and the mass collected in each.
struct LearningOctree {
  Octree octree;
  std::vector<double> masses;  ///< of child c of node i at [8 i + c]; 0 for inner children

  /// Of all leaves together.
  double mass() const;
};

/// When leaves become nodes and nodes leaves (section 5, "Data structure").
struct SplitRule {
  double threshold = 1e-3;  ///< a cell with more than this share of `total_mass` is a node
  int max_depth = 14;       ///< of leaves; the root's own children have depth 0
  double total_mass = 1;    ///< 100 % of `threshold`, and of the densities
};

/// One node with `mass` spread evenly over `box`.
LearningOctree uniform_octree(const Box& box, double mass);

/// The same masses in cells that follow `rule`: a split leaf shares out its mass evenly, over as
/// many levels as it needs; a node that falls below the threshold becomes a leaf with all its mass.
/// Densities are mass over volume and `rule.total_mass`.
LearningOctree refined(const LearningOctree& learned, const SplitRule& rule);

/// The same cells and masses within a box of twice the size about the same center.
LearningOctree enlarged(const LearningOctree& learned);

/// Whether the densest leaf touches the boundary of the box: what is dense there may go on outside.
bool is_densest_at_boundary(const Octree& octree);

/// `octree` without nodes in which no leaf is denser than `ratio` times their mean (section 5,
/// "Pruning", and fig. 6).
Octree pruned(const Octree& octree, double ratio);

}  // namespace pharos::focal
