#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/archive.h>
#include <pharos/core/image.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/rgb.h>
#include <pharos/rendering/filter.h>
#include <pharos/rendering/pixel_shares.h>

namespace pharos {

/// The factors by which paths end or split at some vertices; see TerminationRule.
struct VertexFactors {
  float sum = 0, vertices = 0;  ///< sum of the factors, and number of the vertices

  void add(float factor) {
    sum += factor;
    vertices += 1;
  }
  float mean() const { return vertices > 0 ? sum / vertices : 0; }
};

/// Features of a path, averaged over a pixel.
struct Features {
  Rgb albedo;       ///< of the first surface
  Vec3 normal;      ///< shading normal of the first surface, in world space
  float depth = 0;  ///< distance to the first surface [scene units]; 0 if there is none
  /// At the vertices number 1 and 2, the latter in all branches.
  std::array<VertexFactors, 2> splitting{};
  float cost = 0;  ///< number of steps of the path, in all branches

  Features& operator+=(const Features& other);
};

/// The contribution of one work unit to the film. Pixel samples are added to weighted sums over the
/// unit's pixels and a border as wide as the filter. Splats may fall anywhere and are kept as a
/// list.
class FilmTile {
 public:
  /// `shares` are those by which the pixels get samples; they live as long as the tile.
  FilmTile(PixelRect pixels, PixelRect film, const Filter& filter, const PixelShares& shares);

  const PixelRect& pixels() const { return inner_; }
  /// Adds a sample of radiance at a film position [pixels] within the unit's pixels.
  void add_sample(Vec2 film, Rgb radiance, const Features& features);
  /// Adds a sample without features. The layer `samples` does not count it.
  void add_radiance(Vec2 film, Rgb radiance);
  /// Adds a contribution f/p in units of (pixel value) x (number of paths started), for light
  /// tracing and camera guiding. Positions off the film have no effect.
  void add_splat(Vec2 film, Rgb contribution) { splats_.push_back({film, contribution}); }
  /// Reserves memory for about `n` splats with features.
  void expect_splats(std::size_t n) {
    splats_.reserve(n);
    landings_.reserve(n);
  }
  /// Adds the features of a splat's path. They count as a sample of the pixel at `film`.
  void add_features(Vec2 film, const Features& features) { landings_.push_back({film, features}); }
  /// Counts paths that were started. Splats are divided by the film's total.
  void count_paths(std::uint64_t n) { paths_ += static_cast<double>(n); }

  /// Saves all sums, or loads them into a tile of the same pixels and film.
  void archive(Archive& archive);

 private:
  friend class Film;
  struct Pixel {
    Rgb radiance;               ///< weighted sum
    float weight = 0;           ///< sum of filter weights
    float absolute_weight = 0;  ///< sum of the weights' magnitudes
    Features features;          ///< sums over samples
    float samples = 0;
    float luminance = 0, squared_luminance = 0;  ///< sums over the samples within the pixel

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
  const PixelShares* shares_;
  std::vector<Pixel> pixels_;
  std::vector<Splat> splats_;
  std::vector<Landing> landings_;
  double paths_ = 0;
};

/// Sums over the samples within a pixel, without the pixel filter and without splats.
struct SampleSums {
  double count = 0;
  double value = 0, squares = 0;  ///< of luminances
};

/// The image of one iteration: a layer of pixel samples, normalized by their weights, plus a layer
/// of splats.
///
/// With negative filter lobes, the weights of a few samples may almost cancel out. If their sum is
/// less than the fraction `least_weight` of the sum of their magnitudes, the pixel is divided by
/// that fraction instead. No pixel value then exceeds 1 / least_weight times the brightest sample
/// in reach.
///
/// Tiles are merged in the order of work units, by one thread at a time. Passes end with
/// end_pass(). The variance of a pixel is estimated from the spread of its pass means. This is also
/// correct for stratified samples and splats, and an upper bound if passes of one sequence
/// complement each other.
class Film {
 public:
  /// The default of FilmSettings::least_weight.
  static constexpr float kLeastWeight = 0.1f;

  Film(int width, int height, Ref<Filter> filter, float least_weight = kLeastWeight)
      : Film(PixelRect{0, 0, width, height}, std::move(filter), least_weight) {}
  /// Makes the film of a window of a larger picture. Samples have positions in the larger picture;
  /// positions outside the window are off the film.
  Film(PixelRect window, Ref<Filter> filter, float least_weight = kLeastWeight);

  int width() const { return pixels_.width(); }
  int height() const { return pixels_.height(); }
  const PixelRect& window() const { return pixels_; }
  /// Returns an empty tile. The shares live as long as the tile. If they are not even, samples that
  /// a wide filter spreads over several pixels have weights that make up for it.
  FilmTile make_tile(PixelRect pixels, const PixelShares& shares = kEvenShares) const {
    return {pixels, pixels_, *filter_, shares};
  }
  FilmTile make_tile(PixelRect pixels, PixelShares&& shares) const = delete;

  void merge(const FilmTile& tile);
  /// Ends a pass of `samples` per pixel and adds it to the mean and the variance. A pass that was
  /// cut short (`complete` is false) counts in the mean only. If there are splats and earlier
  /// complete passes, such a pass is dropped, because splats need started paths in proportion to
  /// the shares of the pixels.
  void end_pass(double samples, bool complete = true);
  /// Adds the passes of another film of the same size and filter. Both films must be between
  /// passes.
  void merge(const Film& other);

  /// Returns R G B, followed by every Layer: `albedo`, `normal`, `depth` (means over samples),
  /// `variance` (of the pixel's mean, per channel; infinite before two complete passes), `samples`,
  /// `splitting` (means over vertices; 0 if no path has come so far) and `cost` (mean over
  /// samples).
  Image layers() const;
  double samples_per_pixel() const { return samples_; }
  /// Returns the mean number of steps of the paths of all ended passes
  /// (Features::cost); 0 if there are none.
  double mean_cost() const;
  /// Returns the sums over all samples of a pixel of the window.
  SampleSums sample_sums(int x, int y) const;
  /// The number of passes that were not cut short.
  int complete_passes() const { return complete_passes_; }

  /// Saves all sums, or loads them into a film of the same size and filter. A pass may be in
  /// progress.
  void archive(Archive& archive);

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
  static const PixelShares kEvenShares;
  void add_splat(const FilmTile::Splat& splat);

  PixelRect pixels_;
  Ref<Filter> filter_;
  float least_weight_;
  std::vector<Pixel> total_, pass_;
  std::vector<Moments> moments_;
  /// For each pixel, one over the integral of its filter over the film. Light beyond the edges of
  /// the film makes no splats, so it cannot be filtered in. Empty until there are splats.
  std::vector<float> splat_norms_;
  double samples_ = 0, total_paths_ = 0, pass_paths_ = 0;
  bool is_in_pass_ = false;  ///< something was merged after the last pass
  bool pass_has_splats_ = false;
  double complete_samples_ = 0;  ///< samples per pixel of the passes in `moments_`
  int complete_passes_ = 0;
};

/// Image layers that can be written in addition to the color.
enum class Layer { albedo, normal, depth, variance, samples, splitting, cost };

template <>
struct EnumNames<Layer> {
  static constexpr auto names = std::to_array<EnumName<Layer>>({{"albedo", Layer::albedo},
                                                                {"normal", Layer::normal},
                                                                {"depth", Layer::depth},
                                                                {"variance", Layer::variance},
                                                                {"samples", Layer::samples},
                                                                {"splitting", Layer::splitting},
                                                                {"cost", Layer::cost}});
};

/// Returns the color and the given layers of an image from Film::layers().
Image select_layers(const Image& all, const std::vector<Layer>& layers);

}  // namespace pharos
