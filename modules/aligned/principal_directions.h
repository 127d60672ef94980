#pragma once

#include "directions.h"
#include "von_mises.h"

namespace pharos::aligned {

/// The conditions under which a mode of a histogram is a principal direction.
struct PrincipalSettings {
  int axis_width = 3;     ///< directions at most this far from an axis belong to the axis [degrees]
  double kappa = 50;      ///< concentration of the fitted distributions [1]
  double floor = 0.1;     ///< smallest share of a bin, relative to the mean of all bins [1]
  int window = 5;         ///< largest distance of a mean from the histogram's maximum [degrees]
  int min_distance = 10;  ///< smallest angle between two principal directions [degrees]
  int mass_width = 2;  ///< shares of directions at most this far from a mean are summed [degrees]
  double least_mass = 0.125;  ///< smallest sum of shares for a principal direction [1]

  static void describe(Schema<PrincipalSettings>& schema);
};

/// Returns at most `most` principal directions, in addition to the axes, of an integrand with this
/// histogram. The search starts at the highest bin (section 5.2 of the paper). The result is empty
/// if no direction stands out, as with smooth integrands and curved edges.
FreeDirections principal_directions(const DirectionHistogram& histogram,
                                    const PrincipalSettings& settings, int most);

}  // namespace pharos::aligned
