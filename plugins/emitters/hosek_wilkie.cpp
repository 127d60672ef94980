#include "hosek_wilkie.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hosek_wilkie_data.h"

namespace pharos {
namespace {

constexpr int kTurbidities = 10, kControlPoints = 6;

/// The integral of the matching function of Y [nm]. Mitsuba 0.6 divides by it.
constexpr double kWavelengths = 106.85698;

/// The Bernstein polynomials of degree five at x.
std::array<double, kControlPoints> bernstein(double x) {
  constexpr double kBinomial[kControlPoints] = {1, 5, 10, 10, 5, 1};
  std::array<double, kControlPoints> weights;
  for (int i = 0; i < kControlPoints; ++i) {
    weights[i] = kBinomial[i] * std::pow(1 - x, 5 - i) * std::pow(x, i);
  }
  return weights;
}

/// The place between two neighbors of a table.
struct Between {
  int low;
  double share;  ///< of the neighbor above
};

Between turbidity_place(double turbidity) {
  const int low = std::clamp(static_cast<int>(turbidity), 1, kTurbidities - 1);
  return {low - 1, turbidity - low};
}

/// Calls `entry(albedo, turbidity, point)` for the neighbors in a table and returns the
/// interpolated number.
template <class Entry>
double interpolated(Between turbidity, double albedo,
                    const std::array<double, kControlPoints>& points, Entry&& entry) {
  double sum = 0;
  for (int a = 0; a < 2; ++a) {
    for (int t = 0; t < 2; ++t) {
      const double weight =
          (a == 1 ? albedo : 1 - albedo) * (t == 1 ? turbidity.share : 1 - turbidity.share);
      for (int i = 0; i < kControlPoints && weight > 0; ++i) {
        sum += weight * points[i] * entry(a, turbidity.low + t, i);
      }
    }
  }
  return sum;
}

}  // namespace

HosekWilkieSky::HosekWilkieSky(double turbidity, Rgb ground, double sun_zenith) {
  const double elevation = std::clamp(1 - sun_zenith / (std::numbers::pi / 2), 0.0, 1.0);
  const auto points = bernstein(std::cbrt(elevation));
  const Between place = turbidity_place(turbidity);
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 9; ++k) {
      channels_[c].shape[k] = interpolated(place, ground[c], points, [&](int a, int t, int i) {
        return hosek_wilkie::kShape[c][a][t][i][k];
      });
    }
    channels_[c].mean =
        interpolated(place, ground[c], points,
                     [&](int a, int t, int i) { return hosek_wilkie::kMeanRadiance[c][a][t][i]; }) /
        kWavelengths;
  }
}

double HosekWilkieSky::Channel::radiance(double zenith, double gamma) const {
  const auto [a, b, c, d, e, f, g, h, i] = shape;
  const double up = std::max(std::cos(zenith), 0.0), to_sun = std::cos(gamma);
  const double mie = (1 + to_sun * to_sun) / std::pow(1 + i * i - 2 * i * to_sun, 1.5);
  return mean * (1 + a * std::exp(b / (up + 0.01))) *
         (c + d * std::exp(e * gamma) + f * to_sun * to_sun + g * mie + h * std::sqrt(up));
}

Rgb HosekWilkieSky::radiance(double zenith, double gamma) const {
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    result[c] = static_cast<float>(std::max(0.0, channels_[c].radiance(zenith, gamma)));
  }
  return result;
}

}  // namespace pharos
