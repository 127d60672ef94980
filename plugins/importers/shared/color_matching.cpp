// Converts spectra to linear Rec.709 with the CIE 1931 color matching functions in the fit of
// Wyman, Sloan and Shirley 2013 ("Simple Analytic Approximations to the CIE XYZ Color Matching
// Functions", JCGT 2(2)), summed from 360 to 830 nm in steps of 1 nm. The weighting by light
// follows Mitsuba 3: emission is not weighted, everything else is weighted by daylight.
#include "color_matching.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::importing {
namespace {

constexpr int kFirst = 360, kLast = 830;  ///< wavelengths [nm]
constexpr std::size_t kCount = kLast - kFirst + 1;

struct Xyz {
  double x = 0, y = 0, z = 0;
};
using Weights = std::array<Xyz, kCount>;

/// A Gaussian with a separate width on each side.
double lobe(double wavelength, double mean, double below, double above) {
  const double t = (wavelength - mean) / (wavelength < mean ? below : above);
  return std::exp(-0.5 * t * t);
}

Xyz matching_functions(double l) {
  return {1.056 * lobe(l, 599.8, 37.9, 31.0) + 0.362 * lobe(l, 442.0, 16.0, 26.7) -
              0.065 * lobe(l, 501.1, 20.4, 26.2),
          0.821 * lobe(l, 568.8, 46.9, 40.5) + 0.286 * lobe(l, 530.9, 16.3, 31.1),
          1.217 * lobe(l, 437.0, 11.8, 36.0) + 0.681 * lobe(l, 459.0, 26.0, 13.8)};
}

/// Returns the relative power of the CIE standard illuminant D65 (ISO 11664-2), given every 10 nm
/// and linearly interpolated.
double daylight(double wavelength) {
  constexpr std::array<double, 48> each_10_nm{
      46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008,
      117.812, 114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
      100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
      80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927,
      46.4182, 66.8054, 63.3828, 64.3040, 59.4519, 51.9590, 57.4406, 60.3125};
  const double at = (wavelength - kFirst) / 10;
  const auto i = std::min(static_cast<std::size_t>(at), each_10_nm.size() - 2);
  const double t = at - static_cast<double>(i);
  return (1 - t) * each_10_nm[i] + t * each_10_nm[i + 1];
}

double equal_power(double) {
  return 1;
}

/// Returns the matching functions under a light, scaled so that a spectrum of 1 has the color
/// `white`.
Weights weights(double (*light)(double), Xyz white) {
  Weights all;
  Xyz sum;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double wavelength = kFirst + static_cast<double>(i);
    const Xyz m = matching_functions(wavelength);
    const double power = light(wavelength);
    all[i] = {power * m.x, power * m.y, power * m.z};
    sum = {sum.x + all[i].x, sum.y + all[i].y, sum.z + all[i].z};
  }
  for (Xyz& w : all) w = {w.x * white.x / sum.x, w.y * white.y / sum.y, w.z * white.z / sum.z};
  return all;
}

/// Converts to Rec.709 primaries with white point D65 (ITU-R BT.709).
Rgb rec_709(Xyz c) {
  return {static_cast<float>(3.240479 * c.x - 1.537150 * c.y - 0.498535 * c.z),
          static_cast<float>(-0.969256 * c.x + 1.875991 * c.y + 0.041556 * c.z),
          static_cast<float>(0.055648 * c.x - 0.204043 * c.y + 1.057311 * c.z)};
}

/// Returns the color and the largest value of the spectrum.
std::pair<Rgb, double> summed(const WavelengthFunction& spectrum, const Weights& weights) {
  Xyz sum;
  double largest = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double value = spectrum(kFirst + static_cast<double>(i));
    largest = std::max(largest, value);
    const Xyz& w = weights[i];
    sum = {sum.x + w.x * value, sum.y + w.y * value, sum.z + w.z * value};
  }
  Rgb color = rec_709(sum);
  for (int c = 0; c < 3; ++c) color[c] = std::max(color[c], 0.0f);
  return {color, largest};
}

}  // namespace

Rgb color_of_light(const WavelengthFunction& spectrum) {
  static const Weights equal = weights(equal_power, {1, 1, 1});
  return summed(spectrum, equal).first;
}

Rgb color_in_daylight(const WavelengthFunction& spectrum) {
  constexpr Xyz white{0.950456, 1, 1.088754};  // rec_709() maps it to (1, 1, 1)
  static const Weights daylit = weights(daylight, white);
  auto [color, largest] = summed(spectrum, daylit);
  if (largest > 1) return color;
  for (int c = 0; c < 3; ++c) color[c] = std::min(color[c], 1.0f);
  return color;
}

Rgb color_of_chromaticity(double x, double y) {
  Rgb color = rec_709({x / y, 1, (1 - x - y) / y});
  for (int c = 0; c < 3; ++c) color[c] = std::max(color[c], 0.0f);
  return color;
}

double black_body(double temperature, double wavelength) {
  constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;  // SI, exact
  const double meters = 1e-9 * wavelength;
  const double per_meter =
      2 * h * c * c / (std::pow(meters, 5) * std::expm1(h * c / (meters * k * temperature)));
  return 1e-9 * per_meter;
}

}  // namespace pharos::importing
