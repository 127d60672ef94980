#pragma once

#include <array>

#include <pharos/core/rgb.h>

/// The clear sky by Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance",
/// with their tables for linear Rec.709. Angles are in radians. Radiances are in W/(m^2 sr nm), as
/// in preetham.h.
namespace pharos {

/// The sky for one turbidity, one height of the sun, and one ground.
class HosekWilkieSky {
 public:
  /// Takes `turbidity` in [1, 10], the reflectance of the ground in [0, 1], and the sun's angle
  /// `sun_zenith` in [0, pi / 2] from the zenith.
  HosekWilkieSky(double turbidity, Rgb ground, double sun_zenith);

  /// The radiance at the angle `zenith` in [0, pi / 2) from the zenith and `gamma` from the sun.
  Rgb radiance(double zenith, double gamma) const;

 private:
  /// The distribution of one channel (eq. 8 of the paper).
  struct Channel {
    std::array<double, 9> shape;  ///< A to I
    double mean;                  ///< mean radiance [W/(m^2 sr nm)]
    double radiance(double zenith, double gamma) const;
  };

  std::array<Channel, 3> channels_;
};

}  // namespace pharos
