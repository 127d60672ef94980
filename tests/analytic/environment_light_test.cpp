// Irradiance under environments with known closed forms, for every strategy and sampler.

#include <cmath>
#include <filesystem>
#include <numbers>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>
#include <pharos/tests/fixtures.h>

#include "analytic.h"

namespace pharos::testing {
namespace {

using std::numbers::pi;

TEST_CASE("a constant sky") {
  Floor("", "    - { type: constant, radiance: 2 }\n").check_irradiance(2 * pi, kStrategies);
}

TEST_CASE("a band of an environment map") {
  // Along the angle from the pole, a row of pixels is a hat function of half-width w = pi / height.
  // Multiplied by the cosine and integrated over all azimuths, it gives pi sin(2 angle) w
  // sinc^2(w).
  constexpr int height = 8;
  constexpr double w = pi / height;
  Image image(16, height, {"R", "G", "B"});
  double irradiance = 0;
  for (const int row : {1, 2}) {
    for (int x = 0; x < image.width(); ++x) image.set_rgb(x, row, Rgb(3));
    irradiance += 3 * pi * std::sin(2 * (row + 0.5) * w) * std::pow(std::sin(w), 2) / w;
  }
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "band.exr";
  write_exr(image, path);
  Floor("", fmt::format("    - {{ type: environment_map, file: '{}', "
                        "to_world: {{ rotate: {{ axis: [1, 0, 0], degrees: 90 }} }} }}\n",
                        path.string()))
      .check_irradiance(irradiance, kStrategies);
}

}  // namespace
}  // namespace pharos::testing
