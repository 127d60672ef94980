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
  double weight = 1;  ///< >= 0: of its error in the loss

  friend bool operator==(const TargetPower&, const TargetPower&) = default;
  static void describe(Schema<TargetPower>& schema);
};

/// Which frequencies are suppressed: those where edges have most energy.
struct SuppressionRule {
  double radius = 8;         ///< highest length, in units of the square root of N
  double exact = 0.3;        ///< share of the edges whose normal is a direction itself
  double half_angle = 5;     ///< the normals of the others lie so far about it, evenly [degrees]
  double edge_length = 0.4;  ///< of the edges, in units of the square's edge
  double anywhere = 3;       ///< edges of any normal, for each edge along one direction
  double share = 2;          ///< most of them, in units of N

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

/// The energy that a straight edge of the rule has at the frequency (x, y), which is not (0, 0),
/// but for a factor. At v, an edge of length l with the normal n has
///
///     (v.n)^2 / |v|^4 sinc^2(l t),   t = v x n,
///
/// whose waves across the line of n are smoothed here to 1 / (1 + 2 (pi l t)^2). The mean over the
/// normals at and about `normal`, but for the first factor, which is that of `normal`; those of an
/// axis are all exact, as the edges of the square itself, and of the same length as others.
double edge_energy(int x, int y, Direction normal, const SuppressionRule& rule);

/// The same of an edge whose normal is anywhere: the mean over all of them.
double mean_edge_energy(int x, int y, const SuppressionRule& rule);

/// The frequencies to suppress for `points` points and these directions: within the radius those
/// where the energies of edges along all directions and anywhere add up to most, in the half plane
/// y > 0 or y = 0 < x, as spectra are symmetric. No more than the share, and of equal ones all or
/// none. Their weights are these energies, with the mean one: so the loss is, but for a factor,
/// what these frequencies add to the variance of integrals of such edges (eq. 5 of the paper).
std::vector<TargetPower> suppressed_frequencies(std::uint32_t points,
                                                std::span<const Direction> directions,
                                                const SuppressionRule& rule);

}  // namespace pharos::aligned
