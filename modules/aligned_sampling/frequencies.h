#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/config/schema.h>

namespace pharos::aligned {

/// A frequency [cycles per side of the unit square] whose power is to have a stated value. Powers
/// are relative to independent points, which have 1: |sum over points of exp(-2 pi i v.x)|^2 / N.
struct TargetPower {
  int x = 0, y = 0;
  double power = 0;   ///< >= 0
  double weight = 1;  ///< >= 0: of its squared error in the loss

  friend bool operator==(const TargetPower&, const TargetPower&) = default;
  static void describe(Schema<TargetPower>& schema);
};

/// Which frequencies are suppressed.
struct SuppressionRule {
  double radius = 2;      ///< highest length, in units of the square root of N
  double half_angle = 3;  ///< of the wedge about each direction [degrees]
  double strip = 0.75;  ///< half width of a strip along each direction's line, too, in units of the
                        ///< fourth root of N
  double share = 0.9;   ///< most of them, in units of N
  double low_frequencies = 2;  ///< weights are the length to the power of minus this

  friend bool operator==(const SuppressionRule&, const SuppressionRule&) = default;
  static void describe(Schema<SuppressionRule>& schema);
};

/// A direction of the plane, of unit length.
struct Direction {
  double x = 1, y = 0;
};

/// The direction of an angle from the x axis towards the y axis [degrees], which counts modulo 180;
/// multiples of 90 degrees are exact.
Direction direction_of(double degrees);

/// The frequencies to suppress for `points` points and these directions: those that are no longer
/// than the radius and lie in a wedge or strip about the line of a direction, in the half plane
/// y > 0 or y = 0 < x, as spectra are symmetric. Where these are more than the share allows it is
/// the shortest of them, whole rings only: N points have 2 N coordinates, and N complex amplitudes
/// are the most that they could make zero. The mean of the weights is one.
std::vector<TargetPower> suppressed_frequencies(std::uint32_t points,
                                                std::span<const Direction> directions,
                                                const SuppressionRule& rule);

}  // namespace pharos::aligned
