#pragma once

#include <pharos/core/rgb.h>

#include "xyz.h"

/// Daylight by Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight". Angles
/// are in radians. Radiances are in W/(m^2 sr nm), as means over wavelength weighted by the color
/// matching functions.
namespace pharos {

/// The clear sky for one turbidity and one height of the sun.
class PreethamSky {
 public:
  /// Takes `turbidity` in [1.7, 10] and the sun's angle `sun_zenith` in [0, pi / 2] from the
  /// zenith.
  PreethamSky(double turbidity, double sun_zenith);

  /// The radiance at the angle `zenith` in [0, pi / 2) from the zenith and `gamma` from the sun.
  Rgb radiance(double zenith, double gamma) const;
  /// The luminance at the zenith [kcd/m^2].
  double zenith_luminance() const { return zenith_[0]; }

 private:
  /// The distribution of Perez et al. 1993.
  struct Perez {
    double a, b, c, d, e;
    double evaluate(double zenith, double gamma) const;
  };

  Perez perez_[3];    ///< for luminance Y and chromaticity x, y
  double zenith_[3];  ///< Y [kcd/m^2], x and y at the zenith
  double norm_[3];    ///< inverse of the distribution at the zenith
};

/// The radiance of the sun's disk on the ground if the sun stands at the angle `sun_zenith` in [0,
/// pi / 2] from the zenith.
Rgb preetham_sun_radiance(double turbidity, double sun_zenith);

}  // namespace pharos
