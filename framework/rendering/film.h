#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/core/rgb.h>
#include <pharos/rendering/filter.h>

namespace pharos {

/// A rectangle of pixels, upper bounds exclusive.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

/// First-hit features of a path, averaged over a pixel.
struct Features {
  Rgb albedo;
  Vec3 normal;      ///< shading normal in world space
  float depth = 0;  ///< distance to the first surface [scene units]; 0 when there is none
};

/// What one work unit adds to the film. Pixel samples go to a weighted sum over the unit's pixels
/// and a border as wide as the filter; splats may land anywhere and are kept as a list.
class FilmTile {
 public:
  FilmTile(PixelRect pixels, PixelRect film, const Filter& filter);

  /// A sample of radiance at a film position [pixels] within the unit's pixels.
  void add_sample(Vec2 film, Rgb radiance, const Features& features);
  /// A contribution f/p in units of (pixel value) x (number of paths started): light tracing and
  /// camera guiding. Positions off the film are ignored.
  void add_splat(Vec2 film, Rgb contribution);
  /// Counts paths started; splats are divided by the film's total.
  void count_paths(std::uint64_t n) { paths_ += n; }

 private:
  friend class Film;
  struct Pixel {
    Rgb radiance;
    float weight = 0;
    Features features;
    float samples = 0;
  };
  struct Splat {
    Vec2 film;
    Rgb contribution;
  };

  PixelRect inner_, bordered_, film_;
  const Filter* filter_;
  bool filter_is_one_pixel_;
  std::vector<Pixel> pixels_;
  std::vector<Splat> splats_;
  std::uint64_t paths_ = 0;
};

/// The image of a render: a weight-normalised layer of pixel samples plus a splat layer. Tiles are
/// merged in the order of work units, by one thread at a time. Passes end with end_pass(); the
/// variance of a pixel comes from the spread of its pass means, which is right for stratified
/// samples and splats too.
class Film {
 public:
  Film(int width, int height, Ref<Filter> filter);

  int width() const { return width_; }
  int height() const { return height_; }
  PixelRect pixels() const { return {0, 0, width_, height_}; }
  const Filter& filter() const { return *filter_; }
  FilmTile make_tile(PixelRect pixels) const { return {pixels, this->pixels(), *filter_}; }

  void merge(const FilmTile& tile);
  /// Closes a pass of `samples` a pixel: folds it into the mean and variance. A pass that was cut
  /// short is closed with `complete` false: its samples count in the mean only.
  void end_pass(double samples, bool complete = true);
  /// Forgets everything.
  void clear();
  /// Adds the samples of another film of the same size and filter (both between passes).
  void merge(const Film& other);

  /// Pixel values of all samples so far [unit of radiance].
  Image radiance() const;
  /// R G B, then the layers asked for by name: albedo, normal, depth, variance (of the pixel's mean,
  /// per channel; infinite before two passes), samples (count).
  Image layers(const std::vector<std::string>& names) const;
  static const std::vector<std::string>& layer_names();

  double samples_per_pixel() const { return samples_; }

 private:
  struct Pixel {
    Rgb radiance;        ///< weighted sum
    float weight = 0;    ///< sum of filter weights
    Rgb splats;          ///< sum of f/p
    Features features;   ///< sums over samples
    float samples = 0;
  };
  Rgb value(const Pixel& p, double paths) const;
  void fold_pass_mean(std::size_t i, Rgb value, double samples);

  int width_, height_;
  Ref<Filter> filter_;
  std::vector<Pixel> total_, pass_;
  std::vector<Rgb> pass_mean_, pass_m2_;  ///< weighted Welford over pass values
  double samples_ = 0, pass_weight_ = 0, pass_weight_squared_ = 0;
  double total_paths_ = 0, pass_paths_ = 0;
};

}  // namespace pharos
