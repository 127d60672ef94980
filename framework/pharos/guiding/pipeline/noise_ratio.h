#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <pharos/core/pixel_rect.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Estimates the error of an image of guided paths relative to the error of an image of as many
/// unguided paths, from guided paths alone.
///
/// Let x_j be what a path finds at its vertex j, and r_j the quotient of the densities of guided
/// and unguided sampling of its steps up to there. Unguided sampling would have found x_j r_j,
/// 1 / r_j times as often. The second moment of what unguided paths find is therefore the mean of
///
///     sum_j r_j x_j (x_j + 2 sum_{k > j} x_k)
///
/// over guided paths, and with r_j = 1 it is the second moment of what guided paths find. The x of
/// unguided paths have the MIS weights of unguided paths. Where paths branch, this holds up to the
/// products of x_j and x_k in different branches. Russian roulette and splitting stay as in guided
/// paths.
///
/// The plain ratio of variances would be decided by bright paths that are so rare that no image
/// shows them. The images have n = 128 samples per pixel here, so a pixel shows contributions of up
/// to n times the mean of its surroundings, a tile of 8 x 8 pixels. Brighter ones count as that
/// much in the mean squared error, and what they exceed it by is missing in the image:
///
///     n error = variance of what is shown + n (mean of what is missing)^2
///
/// The variance is measured within pixels, because differences between pixels are no noise. If the
/// pixels of a tile have a single path each, it is measured within the tile. The same holds if they
/// have unequal numbers of paths, as with guides of the camera.
///
/// The ratio is the mean of error over brightness of all pixels, guided over unguided. The
/// brightness is known from earlier iterations, so the first iteration has no ratio.
///
/// An image that shows little of the light has about the error of a black image, even if it shows
/// several times as much as another one. But twice as many samples show twice as much light there.
/// If unguided images show less than half of the light, the ratio is therefore at most the light
/// that they show over the light that guided images show (means over all pixels, relative to their
/// brightness).
class NoiseRatio {
 public:
  explicit NoiseRatio(PixelRect window);

  /// Takes the recorded paths of one work unit.
  void absorb(const PathLog& log);
  /// Ends an iteration. `is_guided`: guides could take part in its paths. Other iterations tell
  /// nothing but the brightness.
  void end_iteration(bool is_guided);
  /// Returns the ratio of the last guided iteration [1]; none if it found no light, or if there was
  /// no light before it.
  std::optional<double> value() const {
    return value_ ? std::optional(value_->mean) : std::nullopt;
  }
  /// Returns the standard error of value() over value() [1], as the tiles scatter. It is too high
  /// where guides help more in some tiles than in others. It is 0 if value() is none or 0, or if
  /// there is a single tile.
  double relative_error() const { return value_ ? value_->relative_error : 0; }
  /// Returns the share of the light that unguided images do not show, as paths of the last guided
  /// iteration found it, in [0, 1]; 0 before.
  double hidden_light() const { return hidden_light_; }
  /// Returns by how much the logarithm of the ratio has fallen from the guided iteration before to
  /// the last one [nats]; none if one of them is unknown. It is infinite if the last one is 0.
  std::optional<double> fall() const;
  /// Returns by how much the logarithm may fall in the next guided iteration [nats]: by as much as
  /// before, and another standard error. None if fall() is none.
  std::optional<double> possible_fall() const;

  void archive(Archive& archive);

 private:
  /// Sums over the paths of the current iteration.
  struct Sums {
    double shown = 0, second_moment = 0;  ///< of what is shown
    double shown_squared = 0;             ///< squares of what each path shows
    double missing = 0, missing_squared = 0;
    void archive(Archive& archive) {
      archive(shown, second_moment, shown_squared, missing, missing_squared);
    }
  };
  /// Sums over the paths of the current iteration in one pixel.
  struct Pixel {
    std::uint32_t paths = 0;
    double guided = 0, unguided = 0;  ///< what is shown
    void archive(Archive& archive) { archive(paths, guided, unguided); }
  };
  /// The light that a path finds at one vertex.
  struct Step {
    double guided = 0, unguided = 0;  ///< x_j, for each with its own MIS weights
    double quotient = 1;              ///< r_j
  };
  /// Sums over the pixels of a tile, or over the tile as if it were a single pixel.
  struct Pairs {
    double count = 0;                 ///< ordered pairs of paths of the same pixel
    double guided = 0, unguided = 0;  ///< squares of what the paths of a pixel show together
    /// Adds a pixel with `n` paths, which show `g` and `u` together.
    void add(double n, double g, double u) {
      count += n * (n - 1);
      guided += g * g;
      unguided += u * u;
    }
  };
  struct Tile {
    double limit = 0;                          ///< a contribution counts at most as much
    double brightness = 0, paths = 0;          ///< sums over all iterations
    double new_brightness = 0, new_paths = 0;  ///< sums over the current iteration
    Sums guided, unguided;
    bool is_measured() const { return new_paths > 1 && limit > 0; }
    void archive(Archive& archive) {
      archive(limit, brightness, paths, new_brightness, new_paths, guided, unguided);
    }
  };

  struct Ratio {
    double mean = 0, relative_error = 0;
    void archive(Archive& archive) { archive(mean, relative_error); }
  };
  /// The quotient of two means over tiles.
  struct Quotient {
    double over = 0, under = 0;  ///< sums over tiles
    double over_squared = 0, under_squared = 0, product = 0;
    int count = 0;
    /// Adds the numerator and the denominator of a tile.
    void add(double a, double b) {
      over += a;
      under += b;
      over_squared += a * a;
      under_squared += b * b;
      product += a * b;
      ++count;
    }
    /// Returns the quotient, with its error to first order; none if the denominator is not
    /// positive.
    std::optional<Ratio> value() const;
  };

  /// Returns the pixels of the film that belong to a tile.
  PixelRect pixels_of(std::size_t tile) const;
  Pairs pairs_in(std::size_t tile) const;
  void find(const PathView& path);
  void add(const PathView& path);
  /// The light of the current iteration in unguided images. Each tile counts relative to its
  /// brightness.
  struct Light {
    double shown = 0, missing = 0;
  };
  Light unguided_light() const;
  /// Returns the ratio of the current iteration. `unguided` is its unguided_light().
  std::optional<Ratio> ratio(const Light& unguided) const;

  PixelRect window_;
  int tiles_per_row_;
  std::vector<Tile> tiles_;              ///< in rows
  std::vector<Pixel> pixels_;            ///< in rows
  std::optional<Ratio> before_, value_;  ///< of the iteration before the last and of the last
  double hidden_light_ = 0;
  std::vector<Step> steps_;  ///< of one path; a member, so that it keeps its memory
};

}  // namespace pharos
