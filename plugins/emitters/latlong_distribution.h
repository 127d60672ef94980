#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "latlong_image.h"

namespace pharos {

/// Directions in proportion to an image of the sphere, nearly: the density interpolates the pixels'
/// means of channels bilinearly in u and in the share of the sphere above, where the image does so
/// in u and v. So it is positive wherever the image is, its integral and inverse are elementary,
/// and solid angle needs no sine. The two differ between rows only, by less than a factor of two
/// next to the poles and less and less away from them.
class LatLongDistribution {
 public:
  /// Refers to `image`. Throws InputError when its integral is beyond a float.
  explicit LatLongDistribution(const LatLongImage& image);

  /// The place that belongs to `u`, continuous in it where the density is not zero: the marginal
  /// of `above` inverted, then the conditional of u. Empty when the image is black, and for the few
  /// u.y, of no measure, that fall on the edge of a black row.
  std::optional<Vec3> sample(Vec2 u) const;
  /// The density of sample() [1/sr]; 0 when the image is black.
  float pdf(const LatLong& place) const;
  /// Of the interpolated means over the sphere of directions [unit of the image times sr].
  float integral() const { return static_cast<float>(total_) * 4 * kPi; }

 private:
  /// Rows `upper` and `lower` of the image, mixed as 1 - t to t.
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
  /// Integral over u from the center of column 0 to that of each column, row by row, in units of a
  /// column's width. Summed in double and rounded: a step lost by that is one that a primary number
  /// of 24 bits could not hit either.
  std::vector<float> cumulative_;
  /// `above` at the upper pole, the rows' centres and the lower pole: band b lies between edges b
  /// and b + 1, between rows b - 1 and b.
  std::vector<double> edges_;
  std::vector<double> bands_;  ///< integral over `above` and u up to each edge
  double total_ = 0;
};

}  // namespace pharos
