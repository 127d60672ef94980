#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

#include <pharos/core/image.h>

/// How far an image is from a reference. Images are channels R, G, B of linear radiance.
namespace pharos {

enum class Metric { mse, capped_mse, relative_mse, mape, smape, psnr, flip, hdr_flip };
inline constexpr std::size_t kMetricCount = 8;

/// What is known of a metric; listed once, shown by tables, reports and the docs.
struct MetricInfo {
  Metric metric;
  std::string_view key;         ///< in JSON and CSV, such as "relative_mse"
  std::string_view title;       ///< in tables, such as "relMSE"
  std::string_view unit;        ///< "" for none
  std::string_view definition;  ///< one line
  std::string_view source;      ///< who defined it so
  bool lower_is_better;
  bool has_ratios;  ///< the ratio of two values says something; not so for decibels
};

/// All metrics, in the order of the enum.
std::span<const MetricInfo> metric_infos();
const MetricInfo& metric_info(Metric metric);

/// The errors of one image. Pixels with a value that is not finite in either image are left out of
/// every metric and counted.
struct ImageErrors {
  std::array<double, kMetricCount> values;  ///< NaN for what was not asked for
  std::size_t invalid_pixels = 0;

  ImageErrors() { values.fill(std::numeric_limits<double>::quiet_NaN()); }
  double& operator[](Metric metric) { return values[static_cast<std::size_t>(metric)]; }
  double operator[](Metric metric) const { return values[static_cast<std::size_t>(metric)]; }
};

/// Added to the squared reference by `relative_mse`, and to magnitudes by `mape` and `smape`, so
/// that dark pixels do not count without bound [unit of the image, squared or not]. A custom of the
/// field, as in the image viewer tev; it supposes images exposed for display.
inline constexpr double kRelativeFloor = 1e-2;

/// `capped_mse` caps the errors of one pixel in this many, the largest ones.
inline constexpr std::size_t kPixelsPerCapped = 1000;

/// The given metrics of `image` against `reference`. Throws InputError when sizes differ, when one
/// has no channels R, G, B, and when no pixel is finite. The same bits for any number of threads.
ImageErrors measure(const Image& image, const Image& reference, std::span<const Metric> metrics);
/// All metrics.
ImageErrors measure(const Image& image, const Image& reference);

/// The error of every pixel, one channel "Y", whose mean the metric is made of: `mse` and
/// `capped_mse` give squared errors, `psnr` those of the clipped image, others their own terms. NaN
/// where a pixel is not finite. Throws as measure() does.
Image error_map(Metric metric, const Image& image, const Image& reference);

}  // namespace pharos
