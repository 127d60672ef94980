#pragma once

#include <vector>

#include <pharos/statistics/varopt.h>

#include "clustering.h"
#include "model.h"
#include "octree.h"

namespace pharos::vertex_triplets {

using Reservoir = statistics::VarOptReservoir<Triplet>;

/// What is fitted to the samples of one cell.
struct CellFit {
  CellKnowledge knowledge;          ///< its `share` is a weight yet
  std::vector<FirstVertex> camera;  ///< their weights are those of the samples
};

/// How samples are fitted.
struct FitRule {
  ModelKind kind;
  ClusterSettings clusters;
};

/// Fits mixtures to a cell's samples, one for each mode (Schuessler et al. 2022, section 6), and
/// one to the first vertices among them. Lengths are in edges of the cell, those to the environment
/// in its distance: what a single sample says of a direction to there is an angle.
CellFit fit_cell(const Reservoir& reservoir, const Cube& cell, const FitRule& rule);

}  // namespace pharos::vertex_triplets
