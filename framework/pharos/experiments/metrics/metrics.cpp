#include <algorithm>
#include <cmath>

#include <pharos/core/parallel.h>
#include <pharos/experiments/metrics/flip.h>
#include <pharos/experiments/metrics/metrics.h>
#include <pharos/experiments/metrics/pixel_pair.h>

namespace pharos {
namespace {

constexpr std::array<MetricInfo, kMetricCount> kInfos{{
    {Metric::mse, "mse", "MSE", "", "mean over pixels of the RGB-mean squared error",
     "custom of the field", true, true},
    {Metric::capped_mse, "capped_mse", "capped MSE", "",
     "MSE with each pixel's error capped at the image's own 99.9 % quantile",
     "Rath, Yazici and Slusallek 2023", true, true},
    {Metric::relative_mse, "relative_mse", "relMSE", "",
     "mean over pixels and RGB of (I - R)^2 / (R^2 + 0.01)",
     "after Rousselle, Knaus and Zwicker 2011, Greedy Error Minimization", true, true},
    {Metric::mape, "mape", "MAPE", "", "mean over pixels and RGB of |I - R| / (|R| + 0.01)",
     "custom of the field", true, true},
    {Metric::smape, "smape", "SMAPE", "",
     "mean over pixels and RGB of |I - R| / ((|I| + |R|) / 2 + 0.01)", "custom of the field", true,
     true},
    {Metric::psnr, "psnr", "PSNR", "dB", "-10 log10 of the MSE of both images clipped to [0, 1]",
     "custom of the field", false, false},
    {Metric::flip, "flip", "FLIP", "",
     "mean difference seen on a display of 67 pixels a degree, images clipped to [0, 1]",
     "Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images", true, true},
    {Metric::hdr_flip, "hdr_flip", "HDR-FLIP", "",
     "mean of each pixel's largest FLIP over a range of exposures, tone mapped by ACES",
     "Andersson et al. 2021, Visualizing Errors in Rendered High Dynamic Range Images", true, true},
}};

using Errors = std::vector<double>;

/// Returns for every pixel the mean of `term(value, reference)` over R, G and B.
template <class Term>
Errors rgb_means(const PixelPair& pair, const Term& term) {
  Errors errors(pair.size());
  parallel_for(static_cast<std::size_t>(pair.height), [&](std::size_t row) {
    for (std::size_t i = row * pair.width; i < (row + 1) * pair.width; ++i) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) {
        sum +=
            term(static_cast<double>(pair.image[i][c]), static_cast<double>(pair.reference[i][c]));
      }
      errors[i] = sum / 3;
    }
  });
  return errors;
}

double squared(double v) {
  return v * v;
}
double squared_error(double value, double reference) {
  return squared(value - reference);
}
double clipped_squared_error(double value, double reference) {
  return squared_error(std::clamp(value, 0.0, 1.0), std::clamp(reference, 0.0, 1.0));
}
double relative_squared_error(double value, double reference) {
  return squared_error(value, reference) / (squared(reference) + kRelativeFloor);
}
double relative_error(double value, double reference) {
  return std::abs(value - reference) / (std::abs(reference) + kRelativeFloor);
}
double symmetric_error(double value, double reference) {
  return std::abs(value - reference) /
         (0.5 * (std::abs(value) + std::abs(reference)) + kRelativeFloor);
}

/// Returns the smallest error that at least 99.9 % of the valid pixels do not exceed. For fewer
/// than kPixelsPerCapped pixels, this is the largest error.
double cap_of(const Errors& errors, const PixelPair& pair) {
  Errors valid;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (pair.valid[i]) valid.push_back(errors[i]);
  }
  const std::size_t above = valid.size() / kPixelsPerCapped;
  const auto quantile = valid.end() - 1 - static_cast<std::ptrdiff_t>(above);
  std::nth_element(valid.begin(), quantile, valid.end());
  return *quantile;
}

Errors capped(Errors errors, const PixelPair& pair) {
  const double cap = cap_of(errors, pair);
  for (double& error : errors) error = std::min(error, cap);
  return errors;
}

Errors pixel_errors(Metric metric, const PixelPair& pair) {
  switch (metric) {
    case Metric::mse:
      return rgb_means(pair, squared_error);
    case Metric::capped_mse:
      return capped(rgb_means(pair, squared_error), pair);
    case Metric::relative_mse:
      return rgb_means(pair, relative_squared_error);
    case Metric::mape:
      return rgb_means(pair, relative_error);
    case Metric::smape:
      return rgb_means(pair, symmetric_error);
    case Metric::psnr:
      return rgb_means(pair, clipped_squared_error);
    case Metric::flip:
      return flip_errors(pair);
    case Metric::hdr_flip:
      return hdr_flip_errors(pair);
  }
  return {};
}

double value_of(Metric metric, const PixelPair& pair) {
  const double mean = mean_error(pixel_errors(metric, pair), pair);
  return metric == Metric::psnr ? -10 * std::log10(mean) : mean;
}

}  // namespace

std::span<const MetricInfo> metric_infos() {
  return kInfos;
}

const MetricInfo& metric_info(Metric metric) {
  return kInfos[static_cast<std::size_t>(metric)];
}

ImageErrors measure(const Image& image, const Image& reference, std::span<const Metric> metrics) {
  const PixelPair pair = pair_pixels(image, reference);
  ImageErrors errors;
  errors.invalid_pixels = pair.invalid_pixels;
  for (const Metric metric : metrics) errors[metric] = value_of(metric, pair);
  return errors;
}

ImageErrors measure(const Image& image, const Image& reference) {
  std::vector<Metric> all;
  for (const MetricInfo& info : kInfos) all.push_back(info.metric);
  return measure(image, reference, all);
}

Image error_map(Metric metric, const Image& image, const Image& reference) {
  const PixelPair pair = pair_pixels(image, reference);
  const Errors errors = pixel_errors(metric, pair);
  Image map(pair.width, pair.height, {"Y"});
  for (std::size_t i = 0; i < errors.size(); ++i) {
    // Squares of large values can exceed the range of a float.
    constexpr double most = std::numeric_limits<float>::max();
    map.values()[i] = pair.valid[i] ? static_cast<float>(std::min<double>(errors[i], most))
                                    : std::numeric_limits<float>::quiet_NaN();
  }
  return map;
}

}  // namespace pharos
