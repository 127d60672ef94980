#pragma once

#include <vector>

#include "cells.h"
#include "quad_tree.h"

namespace pharos::practical_path_guiding {

/// Sums over the records of a cell.
struct Sums {
  QuadTree tree;       ///< values by direction
  double light = 0;    ///< sum of the values
  double squares = 0;  ///< sum of the squared values
  double weight = 0;   ///< number of records
  double steps = 0;    ///< number of steps for which these records stand

  /// Returns Kish's effective number of records, (sum of x)^2 / (sum of x^2). The sum of this many
  /// equal values has the same relative variance. Records without light do not count.
  double effective() const { return squares > 0 ? light * light / squares : 0; }
  /// Returns the mean value of the steps.
  double mean() const { return steps > 0 ? light / steps : 0; }
  void scale(double factor);
  void archive(Archive& archive);
};

/// Mixes the sums of each cell with the sums of the next larger cell of the tree over space, which
/// contains it, and which is itself mixed with the cell above it first. The larger cell has the
/// share prior / (n + prior) in the values by direction, where n is the effective number of the
/// cell's records, and in the mean, where n is their number. So a cell that found little light
/// guides to where cells around it found some, but it knows that little arrives. `weight` stays.
/// `own` and the result are in the order of the numbers of `cells`; larger cells are refined by
/// `kind` and `rule`.
std::vector<Sums> with_larger_cells(const std::vector<const Sums*>& own, const Cells& cells,
                                    double prior, LeafMass kind, const QuadRefinement& rule);

}  // namespace pharos::practical_path_guiding
