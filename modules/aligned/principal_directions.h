#pragma once

#include "directions.h"
#include "von_mises.h"

namespace pharos::aligned {

/// Which of a histogram's modes are principal directions.
struct PrincipalSettings {
  int axis_width = 3;     ///< directions this near to an axis are its own [degrees]
  double kappa = 50;      ///< concentration of the distributions that are fitted [1]
  double floor = 0.1;     ///< least share of a bin, over the mean of all [1]
  int window = 5;         ///< a mean is looked for this far from the histogram's maximum [degrees]
  int min_distance = 10;  ///< between two of them [degrees]
  int mass_width = 2;     ///< shares this far from a mean are added up [degrees]
  double least_mass = 0.125;  ///< what they must add up to [1]

  static void describe(Schema<PrincipalSettings>& schema);
};

/// The principal directions of an integrand with this histogram beside the axes, at most `most`
/// of them, the one with the highest bin first looked for (section 5.2 of the paper). None where no
/// direction stands out, as for smooth integrands and curved edges.
FreeDirections principal_directions(const DirectionHistogram& histogram,
                                    const PrincipalSettings& settings, int most);

}  // namespace pharos::aligned
