#include <algorithm>
#include <cmath>
#include <utility>

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
     "mean over pixels and RGB of (I - R)^2 / (R^2 + e), where e is 1 % of the mean squared "
     "luminance of R",
     "after Rousselle, Knaus and Zwicker 2011, Greedy Error Minimization", true, true},
    {Metric::trimmed_relative_mse, "trimmed_relative_mse", "trimmed relMSE", "",
     "relMSE without the 0.1 % of pixels with the largest errors", "custom of the field", true,
     true},
    {Metric::floored_relative_mse, "floored_relative_mse", "relMSE (0.01)", "",
     "mean over pixels and RGB of (I - R)^2 / (R^2 + 0.01)", "custom of the field", true, true},
    {Metric::mape, "mape", "MAPE", "", "mean over pixels and RGB of |I - R| / (|R| + 0.01)",
     "custom of the field", true, true},
    {Metric::smape, "smape", "SMAPE", "",
     "mean over pixels and RGB of |I - R| / ((|I| + |R|) / 2 + 0.01)", "custom of the field", true,
     true},
    {Metric::psnr, "psnr", "PSNR", "dB",
     "-10 log10 of the MSE of both images, exposed and clipped to [0, 1]", "custom of the field",
     false, false},
    {Metric::flip, "flip", "FLIP", "",
     "mean difference seen on a display of 67 pixels a degree, images exposed and clipped to "
     "[0, 1]",
     "Andersson et al. 2020, FLIP: A Difference Evaluator for Alternating Images", true, true},
    {Metric::hdr_flip, "hdr_flip", "HDR-FLIP", "",
     "mean of each pixel's largest FLIP over a range of exposures, tone mapped by ACES",
     "Andersson et al. 2021, Visualizing Errors in Rendered High Dynamic Range Images", true, true},
}};

/// One number per pixel.
using Errors = std::vector<double>;

/// Returns the number of outliers among `pixels` pixels.
std::size_t outlier_count(std::size_t pixels) {
  return pixels / kPixelsPerOutlier;
}

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
/// The terms of relMSE for one choice of its epsilon.
struct RelativeSquaredError {
  double epsilon;
  double operator()(double value, double reference) const {
    const double error = squared_error(value, reference);
    return error > 0 ? error / (squared(reference) + epsilon) : 0;
  }
};
double relative_error(double value, double reference) {
  return std::abs(value - reference) / (std::abs(reference) + kRelativeFloor);
}
double symmetric_error(double value, double reference) {
  return std::abs(value - reference) /
         (0.5 * (std::abs(value) + std::abs(reference)) + kRelativeFloor);
}

/// Returns the epsilon of relMSE.
double relative_epsilon(const PixelPair& pair) {
  Errors squares(pair.size());
  for (std::size_t i = 0; i < squares.size(); ++i) {
    squares[i] = squared(static_cast<double>(luminance(pair.reference[i])));
  }
  return kRelativeEpsilon * mean_over_pixels(squares, pair);
}

/// Returns the valid pixels, with the outliers last: the 0.1 % of pixels with the largest errors.
/// If errors are equal, the pixels that come last are the outliers.
std::vector<std::size_t> outliers_last(const Errors& errors, const PixelPair& pair) {
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (pair.valid[i]) pixels.push_back(i);
  }
  const auto last = pixels.end() - 1 - static_cast<std::ptrdiff_t>(outlier_count(pixels.size()));
  std::nth_element(pixels.begin(), last, pixels.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(errors[a], a) < std::pair(errors[b], b);
  });
  return pixels;
}

/// Limits errors to the largest error of a pixel that is no outlier.
Errors capped(Errors errors, const PixelPair& pair) {
  const std::vector<std::size_t> pixels = outliers_last(errors, pair);
  const double cap = errors[pixels[pixels.size() - 1 - outlier_count(pixels.size())]];
  for (double& error : errors) error = std::min(error, cap);
  return errors;
}

/// Replaces the errors of outliers by NaN.
Errors trimmed(Errors errors, const PixelPair& pair) {
  const std::vector<std::size_t> pixels = outliers_last(errors, pair);
  for (std::size_t i = pixels.size() - outlier_count(pixels.size()); i < pixels.size(); ++i) {
    errors[pixels[i]] = std::numeric_limits<double>::quiet_NaN();
  }
  return errors;
}

PixelPair exposed(PixelPair pair, const Display& display) {
  const float scale = std::exp2(display.exposure);
  for (auto* pixels : {&pair.image, &pair.reference}) {
    for (Rgb& pixel : *pixels) pixel = scale * pixel;
  }
  return pair;
}

Errors pixel_errors(Metric metric, const PixelPair& pair, const Display& display) {
  switch (metric) {
    case Metric::mse:
      return rgb_means(pair, squared_error);
    case Metric::capped_mse:
      return capped(rgb_means(pair, squared_error), pair);
    case Metric::relative_mse:
      return rgb_means(pair, RelativeSquaredError{relative_epsilon(pair)});
    case Metric::trimmed_relative_mse:
      return trimmed(pixel_errors(Metric::relative_mse, pair, display), pair);
    case Metric::floored_relative_mse:
      return rgb_means(pair, RelativeSquaredError{kRelativeFloor});
    case Metric::mape:
      return rgb_means(pair, relative_error);
    case Metric::smape:
      return rgb_means(pair, symmetric_error);
    case Metric::psnr:
      return rgb_means(exposed(pair, display), clipped_squared_error);
    case Metric::flip:
      return flip_errors(exposed(pair, display));
    case Metric::hdr_flip:
      return hdr_flip_errors(pair);
  }
  return {};
}

double value_of(Metric metric, const PixelPair& pair, const Display& display) {
  const double mean = mean_over_pixels(pixel_errors(metric, pair, display), pair);
  return metric == Metric::psnr ? -10 * std::log10(mean) : mean;
}

}  // namespace

std::span<const MetricInfo> metric_infos() {
  return kInfos;
}

const MetricInfo& metric_info(Metric metric) {
  return kInfos[static_cast<std::size_t>(metric)];
}

ImageErrors measure(const Image& image, const Image& reference, std::span<const Metric> metrics,
                    const Display& display) {
  const PixelPair pair = pair_pixels(image, reference);
  ImageErrors errors;
  errors.invalid_pixels = pair.invalid_pixels;
  for (const Metric metric : metrics) errors[metric] = value_of(metric, pair, display);
  return errors;
}

ImageErrors measure(const Image& image, const Image& reference, const Display& display) {
  std::vector<Metric> all;
  for (const MetricInfo& info : kInfos) all.push_back(info.metric);
  return measure(image, reference, all, display);
}

Image error_map(Metric metric, const Image& image, const Image& reference, const Display& display) {
  const PixelPair pair = pair_pixels(image, reference);
  const Errors errors = pixel_errors(metric, pair, display);
  Image map(pair.width, pair.height, {"Y"});
  for (std::size_t i = 0; i < errors.size(); ++i) {
    // Squares of large values can exceed the range of a float.
    constexpr double most = std::numeric_limits<float>::max();
    const bool counts = pair.valid[i] && !std::isnan(errors[i]);
    map.values()[i] = counts ? static_cast<float>(std::min(errors[i], most))
                             : std::numeric_limits<float>::quiet_NaN();
  }
  return map;
}

}  // namespace pharos
