#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Core>
#include <Eigen/LU>

#include <pharos/core/parallel.h>
#include <pharos/experiments/metrics/flip.h>
#include <pharos/experiments/metrics/plane.h>

namespace pharos {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

// Constants of the paper from 2020.
constexpr double kColorExponent = 0.7;    // q_c, exponent of the color distance
constexpr double kFeatureExponent = 0.5;  // q_f, exponent of the feature difference
constexpr double kKnee = 0.4;             // p_c, fraction of the largest distance at the knee
constexpr double kKneeError = 0.95;       // p_t, error at the knee
constexpr double kEdgeWidth =
    0.082;  // w [degrees], distance from peak to trough of the edge detector
constexpr double kRadiusInDeviations = 3;

/// A contrast sensitivity of the eye as a spatial filter: the sum of one or two Gaussians a
/// sqrt(pi/b) exp(-pi^2 d^2 / b), with d in degrees.
struct Sensitivity {
  struct Term {
    double a, b;
  };
  std::array<Term, 2> terms;
};
constexpr Sensitivity kAchromatic{{{{1, 0.0047}, {0, 1e-5}}}};
constexpr Sensitivity kRedGreen{{{{1, 0.0053}, {0, 1e-5}}}};
constexpr Sensitivity kBlueYellow{{{{34.1, 0.04}, {13.5, 0.025}}}};
constexpr double kWidestTerm = 0.04;

/// The tone curve of Narkowicz 2015 without the exposure of 0.6 that it contains: (n2 x^2 + n1 x) /
/// (d2 x^2 + d1 x + d0).
struct ToneCurve {
  double n2 = 0.36 * 2.51, n1 = 0.6 * 0.03, d2 = 0.36 * 2.43, d1 = 0.6 * 0.59, d0 = 0.14;

  double operator()(double x) const { return (n2 * x + n1) * x / ((d2 * x + d1) * x + d0); }
  /// Returns the x that the curve maps to `t`.
  double inverse(double t) const {
    const double a = n2 - t * d2, b = n1 - t * d1, c = -t * d0;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  }
};
constexpr ToneCurve kToneCurve;
/// The share of white at which the first exposure shows the brightest luminance and the last
/// exposure the median.
constexpr double kShownLuminance = 0.85;
/// Input at which the curve has long reached white. Clamping to it keeps the square from
/// overflowing.
constexpr double kBeyondWhite = 1e6;

/// Converts linear Rec.709 to CIE XYZ under D65, relative to white: each row sums to one.
Matrix3f xyz_from_rgb() {
  Matrix3f m;
  m << 10135552, 8788810, 4435075,  //
      2613072, 8788810, 887015,     //
      1425312, 8788810, 70074185.0f;
  for (int i = 0; i < 3; ++i) m.row(i) /= m.row(i).sum();
  return m;
}
const Matrix3f kXyzFromRgb = xyz_from_rgb();
const Matrix3f kRgbFromXyz = kXyzFromRgb.cast<double>().inverse().cast<float>();

/// Converts XYZ to lightness and two opponent colors. With the cube root applied to XYZ, they are
/// CIE L*a*b*. Without it, they are the related linear space YCxCz.
Vector3f opponents(const Vector3f& v) {
  return {116 * v.y() - 16, 500 * (v.x() - v.y()), 200 * (v.y() - v.z())};
}
Vector3f xyz_from_opponents(const Vector3f& v) {
  const float y = (v.x() + 16) / 116;
  return {y + v.y() / 500, y, y - v.z() / 200};
}

/// The nonlinear curve of CIE L*a*b*.
float lab_root(float t) {
  constexpr float kDelta = 6.0f / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
}

/// Returns L*a*b* with chroma that decreases in the dark (Hunt 1952).
Vector3f hunt_lab(const Vector3f& rgb) {
  const Vector3f lab = opponents((kXyzFromRgb * rgb).unaryExpr(&lab_root));
  return {lab.x(), 0.01f * lab.x() * lab.y(), 0.01f * lab.x() * lab.z()};
}

/// Returns the distance HyAB (Abasi, Tehran and Fairchild 2020) raised to q_c.
float color_distance(const Vector3f& a, const Vector3f& b) {
  const Vector3f d = a - b;
  const float hyab = std::abs(d.x()) + std::hypot(d.y(), d.z());
  return std::pow(hyab, static_cast<float>(kColorExponent));
}

/// Returns the distance of green and blue, which is the largest possible distance.
float largest_distance() {
  return color_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
}

/// Maps a distance to an error in [0, 1].
float color_error(float distance, float largest) {
  constexpr auto kShare = static_cast<float>(kKneeError);
  const float knee = static_cast<float>(kKnee) * largest;
  if (distance < knee) return kShare / knee * distance;
  return std::min(1.0f, kShare + (distance - knee) / (largest - knee) * (1 - kShare));
}

/// Makes a kernel with the weights scale * weight(i), |i| <= radius.
template <class Weight>
Kernel kernel_of(int radius, double scale, Weight&& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) {
    kernel.weights.push_back(static_cast<float>(scale * weight(i)));
  }
  return kernel;
}
template <class Weight>
double sum_of(int radius, Weight&& weight) {
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) sum += weight(i);
  return sum;
}

/// The filter of one channel: the sum of separable filters that is the eye's response.
struct EyeFilter {
  struct Term {
    Kernel x, y;
  };
  std::vector<Term> terms;

  EyeFilter(const Sensitivity& sensitivity, double pixels_per_degree) {
    constexpr double kPi = std::numbers::pi;
    const double deviation = std::sqrt(kWidestTerm / (2 * kPi * kPi)) * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(kRadiusInDeviations * deviation));
    const auto gauss = [&](double b) {
      return [=](int i) { return std::exp(-std::pow(kPi * i / pixels_per_degree, 2) / b); };
    };
    double total = 0;
    for (const auto& [a, b] : sensitivity.terms) {
      total += a * std::sqrt(kPi / b) * std::pow(sum_of(radius, gauss(b)), 2);
    }
    for (const auto& [a, b] : sensitivity.terms) {
      if (a == 0) continue;
      const double share = a * std::sqrt(kPi / b) / total;
      terms.push_back({kernel_of(radius, share, gauss(b)), kernel_of(radius, 1, gauss(b))});
    }
  }
  Plane operator()(const Plane& plane) const {
    Plane result = filtered(plane, terms[0].x, terms[0].y);
    for (std::size_t i = 1; i < terms.size(); ++i) {
      add(result, filtered(plane, terms[i].x, terms[i].y));
    }
    return result;
  }
};

/// Detectors of edges and points: derivatives of a Gaussian with positive and negative weights that
/// each sum to 1.
struct FeatureFilter {
  Kernel blur, edge, point;

  explicit FeatureFilter(double pixels_per_degree) {
    const double deviation = 0.5 * kEdgeWidth * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(kRadiusInDeviations * deviation));
    const auto gauss = [=](int i) { return std::exp(-0.5 * std::pow(i / deviation, 2)); };
    const auto first = [=](int i) { return -i * gauss(i); };
    const auto second = [=](int i) { return (std::pow(i / deviation, 2) - 1) * gauss(i); };
    blur = kernel_of(radius, 1 / sum_of(radius, gauss), gauss);
    edge = balanced(radius, first);
    point = balanced(radius, second);
  }

 private:
  template <class Weight>
  static Kernel balanced(int radius, const Weight& weight) {
    const double above = sum_of(radius, [&](int i) { return std::max(weight(i), 0.0); });
    const double below = sum_of(radius, [&](int i) { return std::max(-weight(i), 0.0); });
    return kernel_of(radius, 1, [&](int i) { return weight(i) / (weight(i) > 0 ? above : below); });
  }
};

struct Eye {
  EyeFilter achromatic, red_green, blue_yellow;
  FeatureFilter features;

  explicit Eye(const Viewer& viewer)
      : achromatic(kAchromatic, viewer.pixels_per_degree),
        red_green(kRedGreen, viewer.pixels_per_degree),
        blue_yellow(kBlueYellow, viewer.pixels_per_degree),
        features(viewer.pixels_per_degree) {}
};

/// An image as the eye perceives it.
struct Seen {
  std::vector<Vector3f> colors;      ///< Hunt-adjusted L*a*b*
  std::vector<float> edges, points;  ///< magnitudes in [0, sqrt 2]
};

std::vector<float> magnitudes(const Plane& x, const Plane& y) {
  std::vector<float> result(x.values.size());
  parallel_for(static_cast<std::size_t>(x.height), [&](std::size_t row) {
    const std::size_t first = row * x.width;
    for (std::size_t i = first; i < first + x.width; ++i) {
      result[i] = std::hypot(x.values[i], y.values[i]);
    }
  });
  return result;
}

/// Returns the perceived image of `pixels`. `shown(rgb)` converts a pixel to the value that the
/// display shows, linear in [0, 1].
template <class Shown>
Seen see(std::span<const Rgb> pixels, int width, int height, const Eye& eye, Shown&& shown) {
  Plane luminance(width, height), y(width, height), cx(width, height), cz(width, height);
  const auto each_pixel = [&](auto&& body) {
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
      for (std::size_t i = row * width; i < (row + 1) * width; ++i) body(i);
    });
  };
  each_pixel([&](std::size_t i) {
    const Rgb c = shown(pixels[i]);
    const Vector3f xyz = kXyzFromRgb * Vector3f(c.r, c.g, c.b);
    const Vector3f v = opponents(xyz);
    luminance.values[i] = xyz.y();
    y.values[i] = v.x(), cx.values[i] = v.y(), cz.values[i] = v.z();
  });
  y = eye.achromatic(y), cx = eye.red_green(cx), cz = eye.blue_yellow(cz);
  Seen seen;
  seen.colors.resize(pixels.size());
  each_pixel([&](std::size_t i) {
    const Vector3f v(y.values[i], cx.values[i], cz.values[i]);
    const Vector3f rgb = kRgbFromXyz * xyz_from_opponents(v);
    seen.colors[i] = hunt_lab(rgb.cwiseMax(0.0f).cwiseMin(1.0f));
  });
  const FeatureFilter& f = eye.features;
  seen.edges = magnitudes(filtered(luminance, f.edge, f.blur), filtered(luminance, f.blur, f.edge));
  seen.points =
      magnitudes(filtered(luminance, f.point, f.blur), filtered(luminance, f.blur, f.point));
  return seen;
}

/// Raises each entry of `worst` to the error between the two perceived images, if the error is
/// larger.
void raise_to_errors(std::vector<double>& worst, const Seen& a, const Seen& b, int height) {
  const float largest = largest_distance();
  const std::size_t width = worst.size() / height;
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const float color = color_error(color_distance(a.colors[i], b.colors[i]), largest);
      const float feature =
          std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i])) /
          std::numbers::sqrt2_v<float>;
      const float sharpened = 1 - std::pow(feature, static_cast<float>(kFeatureExponent));
      worst[i] = std::max(worst[i], static_cast<double>(std::pow(color, sharpened)));
    }
  });
}

template <class Shown>
void raise_to_errors(std::vector<double>& worst, const PixelPair& pair, const Eye& eye,
                     const Shown& shown) {
  raise_to_errors(worst, see(pair.image, pair.width, pair.height, eye, shown),
                  see(pair.reference, pair.width, pair.height, eye, shown), pair.height);
}

float display(double value) {
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

double median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (static_cast<double>(*middle) + *std::max_element(values.begin(), middle));
}

}  // namespace

std::vector<double> flip_errors(const PixelPair& pair, const Viewer& viewer) {
  std::vector<double> errors(pair.size());
  raise_to_errors(errors, pair, Eye(viewer),
                  [](Rgb c) { return Rgb(display(c.r), display(c.g), display(c.b)); });
  return errors;
}

ExposureRange exposure_range(std::span<const Rgb> reference) {
  std::vector<float> luminances;
  for (const Rgb& c : reference) {
    const Rgb light(std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f));
    luminances.push_back(std::min(luminance(light), std::numeric_limits<float>::max()));
  }
  const double largest = *std::max_element(luminances.begin(), luminances.end());
  if (!(largest > 0)) return {};
  double middle = median(luminances);
  if (!(middle > 0)) {
    std::erase_if(luminances, [](float l) { return !(l > 0); });
    middle = median(luminances);
  }
  const double shown = kToneCurve.inverse(kShownLuminance);
  ExposureRange range{.first = std::log2(shown / largest), .last = std::log2(shown / middle)};
  range.last = std::min(range.last, range.first + kMostExposures);
  range.count = std::max(2, static_cast<int>(std::ceil(range.last - range.first)));
  return range;
}

std::vector<double> hdr_flip_errors(const PixelPair& pair, const Viewer& viewer) {
  const Eye eye(viewer);
  std::vector<Rgb> valid;
  for (std::size_t i = 0; i < pair.size(); ++i) {
    if (pair.valid[i]) valid.push_back(pair.reference[i]);
  }
  const ExposureRange range = exposure_range(valid);
  std::vector<double> errors(pair.size());
  for (int i = 0; i < range.count; ++i) {
    const double scale = std::exp2(range.at(i));
    const auto shown = [&](float v) {
      return display(kToneCurve(std::clamp(scale * v, 0.0, kBeyondWhite)));
    };
    raise_to_errors(errors, pair, eye,
                    [&](Rgb c) { return Rgb(shown(c.r), shown(c.g), shown(c.b)); });
  }
  return errors;
}

}  // namespace pharos
