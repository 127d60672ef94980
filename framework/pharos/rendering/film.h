#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/image.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/rgb.h>
#include <pharos/rendering/filter.h>

namespace pharos {

/// First-hit features of a path, averaged over a pixel.
struct Features {
  Rgb albedo;
  Vec3 normal;      ///< shading normal in world space
  float depth = 0;  ///< distance to the first surface [scene units]; 0 when there is none

  Features& operator+=(const Features& other);
};

/// What one work unit adds to the film. Pixel samples go to a weighted sum over the unit's pixels
/// and a border as wide as the filter; splats may land anywhere and are kept as a list.
class FilmTile {
 public:
  FilmTile(PixelRect pixels, PixelRect film, const Filter& filter);

  const PixelRect& pixels() const { return inner_; }
  /// A sample of radiance at a film position [pixels] within the unit's pixels.
  void add_sample(Vec2 film, Rgb radiance, const Features& features);
  /// The same without features; the layer `samples` does not count it.
  void add_radiance(Vec2 film, Rgb radiance);
  /// A contribution f/p in units of (pixel value) x (number of paths started): light tracing and
  /// camera guiding. Positions off the film have no effect.
  void add_splat(Vec2 film, Rgb contribution) { splats_.push_back({film, contribution}); }
  /// What a splat's path saw first; counts as a sample of the pixel it landed in.
  void add_features(Vec2 film, const Features& features) { landings_.push_back({film, features}); }
  /// Counts paths started; splats are divided by the film's total.
  void count_paths(std::uint64_t n) { paths_ += static_cast<double>(n); }

 private:
  friend class Film;
  struct Pixel {
    Rgb radiance;               ///< weighted sum
    float weight = 0;           ///< sum of filter weights
    float absolute_weight = 0;  ///< sum of their magnitudes
    Features features;          ///< sums over samples
    float samples = 0;

    void add(float filter_weight, Rgb value) {
      radiance += filter_weight * value;
      weight += filter_weight;
      absolute_weight += std::abs(filter_weight);
    }
    Pixel& operator+=(const Pixel& other);
    Rgb weighted_mean(float least_weight) const;
  };
  struct Splat {
    Vec2 film;
    Rgb contribution;
  };

  struct Landing {
    Vec2 film;
    Features features;
  };

  PixelRect inner_, bordered_;
  const Filter* filter_;
  std::vector<Pixel> pixels_;
  std::vector<Splat> splats_;
  std::vector<Landing> landings_;
  double paths_ = 0;
};

/// The image of one iteration: a weight-normalized layer of pixel samples plus a splat layer.
/// Filters with negative lobes may leave a pixel of few samples next to no weight; where less than
/// the share `least_weight` of the weights' magnitude is left, that share divides instead, so that
/// no value is more than 1 / least_weight times the brightest sample in reach. Tiles are merged in
/// the order of work units, by one thread at a time. Passes end with end_pass(); the variance of a
/// pixel comes from the spread of its pass means, which is right for stratified samples and splats
/// too (and an upper bound where passes of one sequence complement each other).
class Film {
 public:
  /// See FilmSettings::least_weight, of which this is the default.
  static constexpr float kLeastWeight = 0.1f;

  Film(int width, int height, Ref<Filter> filter, float least_weight = kLeastWeight)
      : Film(PixelRect{0, 0, width, height}, std::move(filter), least_weight) {}
  /// Of a window of a larger picture, at whose positions samples come; what falls beside the window
  /// is not on the film.
  Film(PixelRect window, Ref<Filter> filter, float least_weight = kLeastWeight);

  int width() const { return pixels_.width(); }
  int height() const { return pixels_.height(); }
  FilmTile make_tile(PixelRect pixels) const { return {pixels, pixels_, *filter_}; }

  void merge(const FilmTile& tile);
  /// Closes a pass of `samples` a pixel: folds it into mean and variance. The samples of a pass
  /// that was cut short (`complete` false) count in the mean only, and not at all where splats need
  /// every pixel to have started the same number of paths.
  void end_pass(double samples, bool complete = true);
  /// Adds the passes of another film of the same size and filter; both between passes.
  void merge(const Film& other);

  /// R G B, then every Layer: `albedo`, `normal`, `depth` (means over samples), `variance` (of the
  /// pixel's mean, per channel; infinite before two passes) and `samples`.
  Image layers() const;
  double samples_per_pixel() const { return samples_; }
  /// Passes that were not cut short.
  int complete_passes() const { return complete_passes_; }

 private:
  struct Pixel {
    FilmTile::Pixel sum;
    Rgb splats;  ///< sum of f/p

    Pixel& operator+=(const Pixel& other);
  };
  /// Weighted moments of a pixel's pass values (West 1979).
  struct Moments {
    Rgb mean;
    Rgb squares;  ///< sum of weight x squared deviation
  };
  Rgb value(const Pixel& pixel, double paths) const;
  void find_splat_norms();
  void add_splat(const FilmTile::Splat& splat);

  PixelRect pixels_;
  Ref<Filter> filter_;
  float least_weight_;
  std::vector<Pixel> total_, pass_;
  std::vector<Moments> moments_;
  /// One over the filter's integral over the film, as seen from each pixel: light that falls beside
  /// the film is not there to be filtered in. Empty until there are splats.
  std::vector<float> splat_norms_;
  double samples_ = 0, total_paths_ = 0, pass_paths_ = 0;
  bool pass_has_splats_ = false;
  double complete_samples_ = 0;  ///< a pixel, of the passes in `moments_`
  int complete_passes_ = 0;
};

/// Image layers that can be written besides the color.
enum class Layer { albedo, normal, depth, variance, samples };

template <>
struct EnumNames<Layer> {
  static constexpr std::array<std::pair<std::string_view, Layer>, 5> names{
      {{"albedo", Layer::albedo},
       {"normal", Layer::normal},
       {"depth", Layer::depth},
       {"variance", Layer::variance},
       {"samples", Layer::samples}}};
};

/// The color and the given layers of an image that Film::layers() made.
Image select_layers(const Image& all, const std::vector<Layer>& layers);

}  // namespace pharos
