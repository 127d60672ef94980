#include "latlong_image.h"

#include <algorithm>
#include <cmath>

namespace pharos {

LatLong LatLong::of(Vec3 d) {
  const float turn = std::atan2(d.x, -d.z) / (2 * kPi);
  const double x = d.x, y = d.y, z = d.z;
  const double sine_squared = x * x + z * z;
  // Computed from the sine, because next to a pole the cosine keeps no digits of the angle.
  const double to_pole = sine_squared / (2 * (1 + std::abs(y)));
  return {.u = turn < 0 ? std::min(turn + 1, kOneMinusEpsilon) : turn,
          .v = static_cast<float>(std::atan2(std::sqrt(sine_squared), y)) / kPi,
          .above = y >= 0 ? to_pole : 1 - to_pole};
}

Vec3 LatLong::direction(float u, double above) {
  const float azimuth = 2 * kPi * u;
  const auto sine = static_cast<float>(2 * std::sqrt(above * (1 - above)));
  return {sine * std::sin(azimuth), static_cast<float>(1 - 2 * above), -sine * std::cos(azimuth)};
}

LatLongImage::LatLongImage(const std::filesystem::path& file) : pixels_(read_colors(file)) {
  check_colors(pixels_, file);
}

Rgb LatLongImage::evaluate(const LatLong& place) const {
  const PixelPair across = PixelPair::at(place.u, width());
  const PixelPair down = PixelPair::at(place.v, height());
  const int left = wrapped(across.low), right = wrapped(across.low + 1);
  const auto along = [&](int row) {
    return (1 - across.t) * pixel(left, row) + across.t * pixel(right, row);
  };
  return (1 - down.t) * along(clamped(down.low)) + down.t * along(clamped(down.low + 1));
}

}  // namespace pharos
