#pragma once

#include <vector>

#include <pharos/statistics/varopt.h>

#include "clustering.h"
#include "inheritance.h"
#include "model.h"
#include "octree.h"

namespace pharos::vertex_triplets {

using Reservoir = statistics::VarOptReservoir<Triplet>;

/// The result of fitting the samples of one cell.
struct CellFit {
  CellKnowledge knowledge;          ///< its `share` is a sum of weights, not yet normalized
  std::vector<FirstVertex> camera;  ///< their weights are sums of sample weights
};

/// Parameters of fit_cell().
struct FitRule {
  ModelKind kind;
  ClusterSettings clusters;
  double inherit = 0;        ///< weight of the inheritance [effective samples]
  bool translation = false;  ///< whether the vertices of a single sample have a shift in common
};

/// Fits mixtures to the samples of a cell: one for each mode (Schuessler et al. 2022, section 6),
/// and one for each kind of first vertices. Lengths are in units of the cell's edge. Vertices on
/// the environment are in units of its distance, so the deviation of a single sample is an angle
/// there.
///
/// An inheritance counts as `inherit` effective samples: all of its components together have the
/// weight inherit W / n, where W is the weight and n the effective number (Kish) of the samples of
/// the cell. Each component is a belief in a component of the new mixture (belief.h). Its part of
/// this weight is its share. Modes without samples keep their inherited components, and a cell
/// without samples keeps its inheritance. First vertices are fitted without inheritance, because
/// their mixture is not divided among cells.
///
/// With `translation`, all vertices of a single sample have a shift in common, in addition to the
/// published independent deviations: a light path that was found once is expected to be possible
/// beside itself, in parallel. A single sample does not tell for which part of the cell this
/// holds. The shift therefore has the variance of a point that is evenly distributed over the
/// cell, a twelfth of its squared edge along each axis. It fades together with the independent
/// deviations (eq. 42), because with more samples the covariance shows the correlation itself.
CellFit fit_cell(const Reservoir& reservoir, const Cube& cell, const FitRule& rule,
                 const Inheritance& inheritance = {});

}  // namespace pharos::vertex_triplets
