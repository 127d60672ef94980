#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

/// Measures of how evenly sets of points fill the unit square. All functions throw InputError for
/// an empty set and for points outside [0,1)^2.
namespace pharos::statistics {

/// Returns the star discrepancy: the largest difference, over all boxes [0,a) x [0,b) in the unit
/// square, between the area of the box and its share of the points [1]. The result is exact, by the
/// formula of Bundschuh and Zhu (1993, "A method for exact calculation of the discrepancy of
/// low-dimensional finite point sets I"). The time grows with the square of the number of points.
double star_discrepancy(std::span<const Vec2> points);

/// Returns the quality parameter t of 2^m points as a (t,m,2)-net in base 2 (Niederreiter 1987),
/// from 0, the best, to m. It is the smallest t such that every elementary interval of area 2^(t-m)
/// holds 2^t points. An elementary interval is [i / 2^a, (i + 1) / 2^a) x [j / 2^b, (j + 1) / 2^b).
/// Throws InputError if the number of points is not a power of two.
int net_quality(std::span<const Vec2> points);

/// Returns whether the points are a (0,m,2)-net in base 2: each elementary interval of area 1 / n
/// holds one of the n points. Throws InputError like net_quality().
bool fills_elementary_intervals(std::span<const Vec2> points);

/// The mean power spectrum of realizations of a point set. The power of one realization is the
/// periodogram |sum over the n points of exp(-2 pi i f.p)|^2 / n at integer frequencies f [cycles
/// per edge of the square]. Independent points have an expected power of 1 everywhere. The variance
/// of the integral of a function over toroidally shifted points is a sum over f, divided by n. Its
/// terms are the power times the squared Fourier coefficient of the function. Sums run in the order
/// of the points and of the realizations, on one thread.
class PowerSpectrum {
 public:
  /// Covers the frequencies whose components lie within -max_frequency and max_frequency. Throws
  /// InputError if max_frequency is not positive.
  explicit PowerSpectrum(int max_frequency);

  /// Adds a realization. All realizations have the same weight, whatever their number of points.
  void add(std::span<const Vec2> points);

  int max_frequency() const { return max_frequency_; }
  /// The number of realizations that were added.
  std::size_t count() const { return count_; }

  /// Returns the mean power at frequency (x, y) [1], which is the same at (-x, -y). Returns 0 at
  /// frequency zero, which is left out because its power is always n. Returns 0 everywhere before
  /// the first realization. Throws InputError for a frequency out of range.
  double at(int x, int y) const;

  /// Returns the mean power over rings. Element r holds the mean over the frequencies whose length
  /// rounds to r, for r from 0 (which holds 0) to max_frequency.
  std::vector<double> ring_means() const;

 private:
  int max_frequency_;
  std::size_t count_ = 0;
  /// Sums over realizations for x from 0 and y from -max_frequency. Each row holds one x.
  std::vector<double> sums_;
};

}  // namespace pharos::statistics
