#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/color_map.h>

namespace pharos {
namespace {

/// Every 17th of the 256 colors of magma, sRGB-encoded.
constexpr std::array<Rgb, 16> kMagma{{
    {0.001462f, 0.000466f, 0.013866f},
    {0.043830f, 0.033830f, 0.141886f},
    {0.123833f, 0.067295f, 0.295879f},
    {0.232077f, 0.059889f, 0.437695f},
    {0.341482f, 0.080564f, 0.492631f},
    {0.445163f, 0.122724f, 0.506901f},
    {0.550287f, 0.161158f, 0.505719f},
    {0.658483f, 0.196027f, 0.490253f},
    {0.767398f, 0.233705f, 0.457755f},
    {0.868793f, 0.287728f, 0.409303f},
    {0.944006f, 0.377643f, 0.365136f},
    {0.981000f, 0.498428f, 0.369734f},
    {0.994738f, 0.624350f, 0.427397f},
    {0.997228f, 0.747981f, 0.516859f},
    {0.993170f, 0.870024f, 0.626189f},
    {0.987053f, 0.991438f, 0.749504f},
}};

void check(const ColorScale& scale) {
  const bool finite = std::isfinite(scale.low) && std::isfinite(scale.high);
  if (finite && scale.low < scale.high && (!scale.logarithmic || scale.low > 0)) return;
  throw InputError(
      fmt::format("expected a scale of false colors from low to high{}, found {} to {}",
                  scale.logarithmic ? ", both positive" : "", scale.low, scale.high));
}

}  // namespace

double scale_position(double value, const ColorScale& scale) {
  if (!scale.logarithmic) return (value - scale.low) / (scale.high - scale.low);
  if (value <= scale.low) return 0;
  return std::log(value / scale.low) / std::log(scale.high / scale.low);
}

Rgb magma(double position) {
  const double at = std::clamp(position, 0.0, 1.0) * (kMagma.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kMagma.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(below));
  const Rgb encoded = (1 - t) * kMagma[below] + t * kMagma[below + 1];
  return {linear_from_srgb(encoded.r), linear_from_srgb(encoded.g), linear_from_srgb(encoded.b)};
}

Image false_color(const Image& map, const ColorScale& scale) {
  check(scale);
  Image colors(map.width(), map.height(), {"R", "G", "B"});
  parallel_for(static_cast<std::size_t>(map.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < map.width(); ++x) {
      const double value = *map.pixel(x, y);
      colors.set_rgb(x, y, std::isnan(value) ? kNanColor : magma(scale_position(value, scale)));
    }
  });
  return colors;
}

}  // namespace pharos
