#pragma once

#include <pharos/core/rgb.h>

#include "xyz.h"

/// Daylight by Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight".
/// Angles are in radians, radiances in W/(m^2 sr nm) as means over wavelength, weighted by the
/// color matching functions.
namespace pharos {

/// The clear sky of one turbidity and height of the sun.
class PreethamSky {
 public:
  /// `turbidity` in [1.7, 10]; the sun stands at the angle `sun_zenith` in [0, pi / 2] from the
  /// zenith.
  PreethamSky(double turbidity, double sun_zenith);

  /// At the angle `zenith` in [0, pi / 2) from the zenith and `gamma` from the sun.
  Rgb radiance(double zenith, double gamma) const;
  /// The luminance at the zenith [kcd/m^2].
  double zenith_luminance() const { return zenith_[0]; }

 private:
  /// The distribution of Perez et al. 1993.
  struct Perez {
    double a, b, c, d, e;
    double evaluate(double zenith, double gamma) const;
  };

  Perez perez_[3];    ///< of luminance Y and chromaticity x, y
  double zenith_[3];  ///< Y [kcd/m^2], x and y there
  double norm_[3];    ///< one over the distribution at the zenith
};

/// What of the sun's disk arrives on the ground when the sun stands at the angle `sun_zenith` in
/// [0, pi / 2] from the zenith.
Rgb preetham_sun_radiance(double turbidity, double sun_zenith);

}  // namespace pharos
