#pragma once

#include <vector>

#include "cells.h"
#include "quad_tree.h"

namespace pharos::practical_path_guiding {

/// What the records of a cell add up to.
struct Sums {
  QuadTree tree;       ///< values by direction
  double light = 0;    ///< sum of the values
  double squares = 0;  ///< sum of the squared values
  double weight = 0;   ///< number of records
  double steps = 0;    ///< number of steps for which these records stand

  /// Returns Kish's effective number of records, (sum of x)^2 / (sum of x^2): so many records of
  /// equal value are as reliable.
  double effective() const { return squares > 0 ? light * light / squares : 0; }
  /// Returns the mean value of the steps.
  double mean() const { return steps > 0 ? light / steps : 0; }
  void scale(double factor);
  void archive(Archive& archive) { archive(tree, light, squares, weight, steps); }
};

/// Mixes what each cell knows with what the next larger cell of the tree over space knows, which is
/// itself mixed with the cell above it first. The larger cell has the share prior / (n + prior) in
/// the density over directions and in the mean, where n is the cell's effective number of records.
/// So a cell that found little light guides to where the cells around it found some. `own` and the
/// result are in the order of the numbers of `cells`.
std::vector<Sums> with_larger_cells(const std::vector<const Sums*>& own, const Cells& cells,
                                    double prior, const QuadRefinement& rule);

}  // namespace pharos::practical_path_guiding
