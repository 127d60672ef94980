#pragma once

#include <cstdint>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>

#include "pixel_map.h"

namespace pharos {

/// How an image is denoised: by an edge-avoiding a-trous filter (Dammertz et al. 2010,
/// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering"). Level i is a
/// B3 spline over 5 x 5 pixels that lie 2^i pixels apart. It spares edges of reflectance and of
/// normals.
struct Denoising {
  std::uint32_t levels = 2;  ///< 0: none
  float albedo_edge = 0.1f;  ///< difference of reflectances that is an edge [1]
  float normal_edge = 0.3f;  ///< difference of unit normals that is an edge [1]
  static void describe(Schema<Denoising>& s);
};

/// The image as far as paths have found it: sums of their values for each pixel, and features of
/// the first surfaces that the sensor sees.
class FilmEstimate {
 public:
  explicit FilmEstimate(const PixelRect& window) : window_(window), pixels_(window.area()) {}

  /// What a path tells of a pixel.
  struct Sample {
    double value = 0;  ///< mean of the channels, times `paths`
    /// Number of paths of evenly chosen film positions for which the path counts.
    double paths = 1;
    Rgb albedo;   ///< as PathView::albedo
    Vec3 normal;  ///< as PathView::normal
  };
  /// Adds a path that ends at a film position [pixels].
  void add(Vec2 film, const Sample& sample);

  /// Returns the mean over all pixels; 0 if there are no paths.
  double mean() const;
  /// Returns the denoised image. Pixels without paths nearby are black.
  PixelMap denoised(const Denoising& rule) const;

  void archive(Archive& archive);

 private:
  struct Pixel {
    double value = 0, paths = 0;
    double count = 0;  ///< of the summed features
    Rgb albedo;
    Vec3 normal;
    void archive(Archive& archive) { archive(value, paths, count, albedo, normal); }
  };
  /// Returns the pixels with mean features.
  std::vector<Pixel> with_mean_features() const;
  /// Returns the pixels after one level of the filter.
  std::vector<Pixel> filtered(const std::vector<Pixel>& image, int step,
                              const Denoising& rule) const;

  PixelRect window_;
  std::vector<Pixel> pixels_;  ///< sums
};

}  // namespace pharos
