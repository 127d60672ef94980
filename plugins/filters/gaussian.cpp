// gaussian: g(x) g(y) with g(x) = exp(-x^2 / (2 s^2)) - exp(-r^2 / (2 s^2)), where s is the
// standard deviation. The second term lowers the Gaussian, so that it reaches zero at the radius r
// without a step. A deviation of 0.1 still gives the corners of a pixel weights that a float can
// divide by.
//
//     { type: gaussian, stddev: 0.5, radius: 1.5 }
#include "gaussian.h"

namespace pharos {

void GaussianFilter::Settings::describe(Schema<Settings>& s) {
  s.field("stddev", &Settings::stddev, "Standard deviation").unit("pixels").at_least(0.1);
  s.field("radius", &Settings::radius, "Half-width").unit("pixels").at_least(0.5).at_most(16);
  s.example("{ stddev: 0.25, radius: 1 }");
  s.example("{ stddev: 1, radius: 2.5 }");
}

GaussianFilter::GaussianFilter(const Settings& settings)
    : settings_(settings), exponent_(-0.5f / (settings.stddev * settings.stddev)) {
  const double s = settings.stddev, r = settings.radius;
  const double floor = std::exp(-0.5 * r * r / (s * s));
  const double side = s * std::sqrt(2 * M_PI) * std::erf(r / (s * M_SQRT2)) - 2 * r * floor;
  floor_ = static_cast<float>(floor);
  integral_ = static_cast<float>(side * side);
}

float GaussianFilter::profile(float x) const {
  return std::max(0.0f, std::exp(exponent_ * x * x) - floor_);
}

}  // namespace pharos
