// A closed sphere whose wall emits radiance 1 and reflects the share a of the light that it
// receives. The radiance is 1 + a + a^2 + … = 1 / (1 - a) everywhere and in every direction.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "analytic.h"

namespace pharos::testing {
namespace {

void check_enclosure(double albedo, const std::string& integrator) {
  CAPTURE(albedo);
  const std::string scene = fmt::format(
      R"(scene:
  materials:
    wall: {{ type: diffuse, reflectance: {} }}
  shapes:
    - {{ type: sphere, radius: 2, flip_normals: true, material: wall, emitter: {{ type: area, radiance: 1 }} }}
  sensor: {{ type: perspective, fov: 70, to_world: {{ look_at: {{ origin: [-0.3, 0.1, -0.6], target: [0, 0, 0.5], up: [0, 1, 0] }} }} }}
)",
      albedo);
  for (const std::string sampler : kSamplers) {
    CAPTURE(sampler);
    check_value(
        scene + kFilm +
            fmt::format("integrator: {{ type: path, {} }}\nsampler: {}\n", integrator, sampler),
        1 / (1 - albedo));
  }
}

struct Wall {
  double albedo;
  int bounces;  ///< number of bounces after which 0.2 % of the light is missing
};
constexpr Wall kWalls[] = {{0.2, 4}, {0.5, 9}, {0.8, 28}, {0.95, 121}};

TEST_CASE("enclosure: paths end by roulette") {
  for (const auto& [albedo, bounces] : kWalls) {
    const std::string roulette =
        fmt::format("max_depth: 10000, roulette: throughput, roulette_depth: {}", bounces);
    check_enclosure(albedo, roulette);
    check_enclosure(albedo, roulette + ", next_event_estimation: false");
  }
}

TEST_CASE("enclosure: paths end by length") {
  for (const auto& [albedo, bounces] : kWalls) {
    // The cut-off part is 4e-6 of the light, less than the rounding error that check_value()
    // allows.
    check_enclosure(albedo, fmt::format("max_depth: {}", 2 * bounces));
  }
}

}  // namespace
}  // namespace pharos::testing
