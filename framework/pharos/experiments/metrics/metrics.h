#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

#include <pharos/core/image.h>

/// Metrics for the distance of an image from a reference. Images are channels R, G, B of linear
/// radiance.
namespace pharos {

enum class Metric {
  mse,
  capped_mse,
  relative_mse,
  trimmed_relative_mse,
  floored_relative_mse,
  mape,
  smape,
  psnr,
  flip,
  hdr_flip
};
inline constexpr std::size_t kMetricCount = 10;

/// The description of a metric. Metrics are listed once, and the tables, reports and docs show this
/// list.
struct MetricInfo {
  Metric metric;
  std::string_view key;         ///< in JSON and CSV, such as "relative_mse"
  std::string_view title;       ///< in tables, such as "relMSE"
  std::string_view unit;        ///< empty for none
  std::string_view definition;  ///< one line
  std::string_view source;      ///< the publication that defines it
  bool lower_is_better;
  bool has_ratios;  ///< whether ratios of values are meaningful; false for decibels
};

/// Returns all metrics, in the order of the enum.
std::span<const MetricInfo> metric_infos();
const MetricInfo& metric_info(Metric metric);

/// The errors of one image. Pixels with a value that is not finite in either image are left out of
/// every metric and counted.
struct ImageErrors {
  std::array<double, kMetricCount> values;  ///< NaN for metrics that were not requested
  std::size_t invalid_pixels = 0;

  ImageErrors() { values.fill(std::numeric_limits<double>::quiet_NaN()); }
  double& operator[](Metric metric) { return values[static_cast<std::size_t>(metric)]; }
  double operator[](Metric metric) const { return values[static_cast<std::size_t>(metric)]; }
};

/// `relative_mse` and `trimmed_relative_mse` add this fraction of the reference's mean squared
/// luminance to the squared reference. The error of dark pixels thus stays bounded, and the metrics
/// do not depend on the unit of radiance.
inline constexpr double kRelativeEpsilon = 1e-2;

/// The floor that `floored_relative_mse` adds to the squared reference, and `mape` and `smape` to
/// magnitudes [unit of the image, squared or not]. The value is a convention of the field, also
/// used by the image viewer tev. It assumes images exposed for display.
inline constexpr double kRelativeFloor = 1e-2;

/// `capped_mse` caps the errors of one pixel in this many, and `trimmed_relative_mse` leaves them
/// out: the pixels with the largest errors.
inline constexpr std::size_t kPixelsPerOutlier = 1000;

/// How images are shown before they are compared by what a display can show, for `psnr` and `flip`.
struct Display {
  float exposure = 0;  ///< values are scaled by 2^exposure [stops]
};

/// Returns the given metrics of `image` against `reference`. The result has the same bits for any
/// number of threads. Throws InputError if the sizes differ, if an image has no channels R, G, B,
/// or if no pixel is finite.
ImageErrors measure(const Image& image, const Image& reference, std::span<const Metric> metrics,
                    const Display& display = {});
/// Returns all metrics of `image` against `reference`.
ImageErrors measure(const Image& image, const Image& reference, const Display& display = {});

/// Returns the error of every pixel in one channel "Y". The metric is computed from the mean of
/// these errors: squared errors for `mse` and `capped_mse`, squared errors of the clipped images
/// for `psnr`, and the metric's own terms otherwise. A pixel that is not finite, or that the metric
/// leaves out, is NaN. Throws as measure() does.
Image error_map(Metric metric, const Image& image, const Image& reference,
                const Display& display = {});

}  // namespace pharos
