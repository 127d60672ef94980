#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/config/schema.h>

namespace pharos::aligned {

/// A frequency [cycles per side of the unit square] and the power that the points should have
/// there. Powers are relative to independent points, which have 1: |sum over points of exp(-2 pi i
/// v.x)|^2 / N.
struct TargetPower {
  int x = 0, y = 0;
  double power = 0;   ///< >= 0
  double weight = 1;  ///< weight of the power's error in the loss, >= 0

  friend bool operator==(const TargetPower&, const TargetPower&) = default;
  static void describe(Schema<TargetPower>& schema);
};

/// The rule that selects the suppressed frequencies: the frequencies at which edges have most
/// energy.
struct SuppressionRule {
  double radius = 8;         ///< largest length of a frequency, in units of the square root of N
  double exact = 0.3;        ///< share of the edges whose normal is exactly a direction
  double half_angle = 5;     ///< largest angle between a direction and the other normals, which are
                             ///< distributed evenly [degrees]
  double edge_length = 0.4;  ///< length of the edges, in units of the square's edge
  double anywhere = 3;       ///< edges with arbitrary normals, for each edge along one direction
  double share = 2;          ///< largest number of frequencies, in units of N

  friend bool operator==(const SuppressionRule&, const SuppressionRule&) = default;
  static void describe(Schema<SuppressionRule>& schema);
};

/// A direction in the plane, of unit length.
struct Direction {
  double x = 1, y = 0;
};

/// Returns the direction at an angle from the x axis toward the y axis [degrees]. Angles count
/// modulo 180 degrees. Multiples of 90 degrees are exact.
Direction direction_of(double degrees);

/// Returns, up to a constant factor, the energy that a straight edge of the rule has at the
/// frequency (x, y), which must not be (0, 0). At v, an edge of length l with normal n has the
/// energy
///
///     (v.n)^2 / |v|^4 sinc^2(l t),   t = v x n.
///
/// The squared sinc, which oscillates across the line along n, is smoothed to 1 / (1 + 2 (pi l
/// t)^2). The result is the mean over the normals at and about `normal`, except for the first
/// factor, which uses `normal` itself. If `normal` is an axis, all normals are exact, like the
/// edges of the square itself. These edges have the same length as others.
double edge_energy(int x, int y, Direction normal, const SuppressionRule& rule);

/// Returns the same energy for an edge with an arbitrary normal: the mean over all normals.
double mean_edge_energy(int x, int y, const SuppressionRule& rule);

/// Returns the frequencies to suppress for `points` points and these directions. They are the
/// frequencies within the radius for which the sum of the energies of edges along all directions
/// and of edges with arbitrary normals is highest. Only the half plane y > 0 or y = 0 < x is used,
/// because spectra are symmetric. There are at most `share` times `points` frequencies; of
/// frequencies with equal energies, all or none are taken. Their weights are these energies,
/// normalized to a mean of one. Up to a constant factor, the loss is therefore the contribution of
/// these frequencies to the variance of integrals of such edges (eq. 5 of the paper).
std::vector<TargetPower> suppressed_frequencies(std::uint32_t points,
                                                std::span<const Direction> directions,
                                                const SuppressionRule& rule);

}  // namespace pharos::aligned
