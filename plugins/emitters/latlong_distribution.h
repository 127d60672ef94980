#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "latlong_image.h"

namespace pharos {

/// A distribution of directions that is nearly proportional to an image of the sphere. The density
/// interpolates the mean of each pixel's channels bilinearly in u and in the share of the sphere
/// above, while the image itself is bilinear in u and v. Therefore the density is positive wherever
/// the image is, its integral and inverse are elementary, and solid angle needs no sine. Density
/// and image differ only between rows, by less than a factor of two next to the poles and less and
/// less away from them.
class LatLongDistribution {
 public:
  /// Refers to `image`. Throws InputError if the image's integral exceeds the range of float.
  explicit LatLongDistribution(const LatLongImage& image);

  /// Maps `u` to a direction, continuously wherever the density is not zero. It inverts first the
  /// marginal distribution of `above`, then the conditional distribution of u. Empty if the image
  /// is black, and for a set of u.y of measure zero that falls on the edge of a black row.
  std::optional<Vec3> sample(Vec2 u) const;
  /// The density of sample() [1/sr]; 0 if the image is black.
  float pdf(const LatLong& place) const;
  /// The integral of the interpolated means over the sphere of directions [unit of the image times
  /// sr].
  float integral() const { return static_cast<float>(total_) * 4 * kPi; }

 private:
  /// Rows `upper` and `lower` of the image, mixed with the weights 1 - t and t.
  struct Blend {
    int upper, lower;
    double t;
    double of(double at_upper, double at_lower) const { return (1 - t) * at_upper + t * at_lower; }
  };

  double weight(int column, const Blend& rows) const;
  double cumulative(int column, const Blend& rows) const;
  double row_sum(int row) const { return cumulative_[index(image_.width(), row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width() + 1) +
           static_cast<std::size_t>(column);
  }
  float sample_column(float u, const Blend& rows) const;

  void add_row(int row);
  void add_bands();

  const LatLongImage& image_;
  /// The integral over u from the center of column 0 to the center of each column, row by row, in
  /// units of a column's width. The sums are computed in double precision and rounded to float. A
  /// step lost by this rounding is too small for a random number of 24 bits to hit anyway.
  std::vector<float> cumulative_;
  /// `above` at the upper pole, the rows' centers and the lower pole. Band b lies between edges b
  /// and b + 1, that is between rows b - 1 and b.
  std::vector<double> edges_;
  std::vector<double> bands_;  ///< integral over `above` and u up to each edge
  double total_ = 0;
};

}  // namespace pharos
