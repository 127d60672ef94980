// lanczos: s(x / n) s(x) s(y / n) s(y) with s(t) = sin(pi t) / (pi t), up to the radius of n
// pixels. It is the ideal low-pass filter, windowed by the middle lobe of a wider one (Duchon 1979,
// "Lanczos Filtering in One and Two Dimensions"). It keeps the most detail of all filters here.
// Every other one of its `lobes` is negative, so bright edges have dark fringes, and noise is
// amplified in pixels with few samples.
//
//     { type: lanczos, lobes: 3 }
#include "lanczos.h"

#include <cmath>
#include <numbers>

namespace pharos {
namespace {

double sinc(double x) {
  const double t = std::numbers::pi * x;
  return std::abs(t) > 1e-8 ? std::sin(t) / t : 1;
}

/// Half the integral of the profile with `lobes` lobes, by Simpson's rule. The relative error of
/// the whole integral is below 1e-8.
double half_side(int lobes) {
  constexpr int kSteps = 64;  // per lobe
  double sum = 0;
  for (int i = 0; i <= kSteps * lobes; ++i) {
    const double x = static_cast<double>(i) / kSteps;
    const double weight = i == 0 || i == kSteps * lobes ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * sinc(x) * sinc(x / lobes);
  }
  return sum / (3 * kSteps);
}

}  // namespace

void LanczosFilter::Settings::describe(Schema<Settings>& s) {
  s.field("lobes", &Settings::lobes,
          "Number of zero crossings on each side, equal to the half-width")
      .unit("pixels")
      .at_least(1)
      .at_most(16);
  s.example("{ lobes: 1 }");
  s.example("{ lobes: 5 }");
}

LanczosFilter::LanczosFilter(const Settings& settings)
    : radius_(static_cast<float>(settings.lobes)) {
  const double side = 2 * half_side(settings.lobes);
  integral_ = static_cast<float>(side * side);
}

float LanczosFilter::profile(float x) const {
  if (!(std::abs(x) < radius_)) return 0;
  return static_cast<float>(sinc(x) * sinc(x / radius_));
}

}  // namespace pharos
