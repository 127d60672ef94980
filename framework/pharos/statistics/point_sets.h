#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <pharos/core/vec.h>

/// How evenly sets of points fill the unit square. All functions throw InputError for an empty set
/// and for points outside [0,1)^2.
namespace pharos::statistics {

/// The star discrepancy: the largest difference, over all boxes [0,a) x [0,b) in the unit square,
/// between the box's area and its share of the points [1]. Exact, by the formula of Bundschuh and
/// Zhu (1993, "A method for exact calculation of the discrepancy of low-dimensional finite point
/// sets I"); takes time that grows with the square of the number of points.
double star_discrepancy(std::span<const Vec2> points);

/// The quality parameter t of 2^m points as a (t,m,2)-net in base 2 (Niederreiter 1987): the
/// smallest t such that every elementary interval of area 2^(t-m) holds 2^t points. An elementary
/// interval is [i / 2^a, (i + 1) / 2^a) x [j / 2^b, (j + 1) / 2^b). From 0, the best, to m. Throws
/// InputError when the number of points is no power of two.
int net_quality(std::span<const Vec2> points);

/// Whether the points are a (0,m,2)-net in base 2: each elementary interval of area 1 / n holds one
/// of the n points. Throws as net_quality() does.
bool fills_elementary_intervals(std::span<const Vec2> points);

/// The mean power spectrum of realizations of a point set: of each, the periodogram
/// |sum over the n points of exp(-2 pi i f.p)|^2 / n at integer frequencies f [cycles per edge of
/// the square]. Independent points have an expected power of 1 everywhere; the variance of the
/// integral of a function over toroidally shifted points is the sum over f of the power times the
/// function's own squared Fourier coefficient, over n. Sums run in the order of the points and of
/// the realizations, on one thread.
class PowerSpectrum {
 public:
  /// Frequencies whose components lie within -max_frequency and max_frequency. Throws InputError
  /// when that is not positive.
  explicit PowerSpectrum(int max_frequency);

  /// Adds a realization; each counts the same, whatever its number of points.
  void add(std::span<const Vec2> points);

  int max_frequency() const { return max_frequency_; }
  /// How many realizations were added.
  std::size_t count() const { return count_; }

  /// The mean power at frequency (x, y) [1]; the same at (-x, -y). 0 at frequency zero, which is
  /// left out as it always holds n, and everywhere before the first realization. Throws InputError
  /// for a frequency out of range.
  double at(int x, int y) const;

  /// The mean power over rings: element r holds the mean over frequencies whose length rounds to r,
  /// for r from 0 (which holds 0) to max_frequency.
  std::vector<double> ring_means() const;

 private:
  int max_frequency_;
  std::size_t count_ = 0;
  /// Sums over realizations for x from 0, y from -max_frequency: rows of one x.
  std::vector<double> sums_;
};

}  // namespace pharos::statistics
