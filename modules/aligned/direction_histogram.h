#pragma once

#include <array>
#include <span>

#include "directions.h"
#include "probe_grid.h"

namespace pharos::aligned {

/// The variation of an integrand by direction. Element k belongs to the directions within half a
/// degree of k.
using DirectionHistogram = std::array<double, kDirections>;

/// The definition of an edge.
struct EdgeSettings {
  /// Standard deviation of the Gaussian filter before gradients are taken [cells].
  float sigma = 2.2f;
  /// The height of the lowest step that counts as an edge, as a share of the range of the filtered
  /// values [1]. Slopes that are less steep than the slope of this step do not count, because
  /// smooth integrands have no edges.
  float least_step = 0.25f;

  static void describe(Schema<EdgeSettings>& schema);
};

/// Returns the directions of the gradients of `values`, weighted by the length of the gradients
/// (section 5.1 of the paper). A Gaussian filter and a Sobel filter give the gradients. `values`
/// are the values at grid.points(), tile after tile. Each tile is filtered separately. Gradients
/// within sigma of a tile's border are left out, because the filter is not symmetric there. The
/// histogram is zero if the values are constant except for rounding.
DirectionHistogram direction_histogram(std::span<const float> values, const ProbeGrid& grid,
                                       const EdgeSettings& settings);

}  // namespace pharos::aligned
