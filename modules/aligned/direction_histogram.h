#pragma once

#include <array>
#include <span>

#include "directions.h"
#include "probe_grid.h"

namespace pharos::aligned {

/// How much an integrand varies in each direction; element k is for the directions within half a
/// degree of k.
using DirectionHistogram = std::array<double, kDirections>;

/// What counts as an edge.
struct EdgeSettings {
  /// Standard deviation of the Gaussian filter before gradients are taken [cells].
  float sigma = 2.2f;
  /// The lowest edge that counts, as a share of the range of the filtered values [1]. Slopes that
  /// are less steep than its are none: smooth integrands have no edges.
  float least_step = 0.25f;

  static void describe(Schema<EdgeSettings>& schema);
};

/// The directions of the gradients of `values`, weighted by their length (section 5.1 of the
/// paper): those of a Gaussian filter and Sobel's operator. `values` are those at grid.points(),
/// tile after tile. Tiles are filtered each by itself; what lies within sigma of their borders,
/// where the filter is lopsided, is left out. All zero where the values are constant but for
/// rounding.
DirectionHistogram direction_histogram(std::span<const float> values, const ProbeGrid& grid,
                                       const EdgeSettings& settings);

}  // namespace pharos::aligned
