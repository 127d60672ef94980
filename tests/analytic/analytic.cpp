#include "analytic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace pharos::testing {
namespace {

/// Returns the mean over the seeds, rendered with enough samples for a small standard error.
Estimate precise_mean(const std::string& config, double expected) {
  constexpr double kPower90 = 1.34;  // 90 % quantile of t, 15 degrees of freedom
  const double wanted = kDetectableBias * expected / (kLimit + kPower90);
  // The first step has 16 samples per pixel: events with a probability of 1/500 per path must occur
  // before the spread over seeds is meaningful.
  for (int spp = 16;; spp *= 4) {
    const Estimate found =
        mean_over_seeds(config + fmt::format("budget: {{ spp: {} }}\n", spp), kRuns);
    if (found.standard_error < wanted) return found;
    REQUIRE_MESSAGE(spp < 4096, "too noisy: error " << found.standard_error);
  }
}

}  // namespace

void check_value(const std::string& config, double expected) {
  const Estimate found = precise_mean(config, expected);
  // If there is no noise, rounding errors of floats remain.
  const double error = std::max(found.standard_error, 1e-5 * expected);
  const auto t = [&](double value) { return (found.mean - value) / error; };
  CAPTURE(found.mean);
  CAPTURE(expected);
  CHECK(std::abs(t(expected)) < kLimit);
  CHECK(t(1.01 * expected) < -kLimit);
  CHECK(t(0.99 * expected) > kLimit);
}

double polygon_irradiance(const Transform& quad) {
  const std::array<Point3, 4> corners{quad.point({-1, -1, 0}), quad.point({1, -1, 0}),
                                      quad.point({1, 1, 0}), quad.point({-1, 1, 0})};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    REQUIRE(corners[i].z > 0);
    const Vec3 a = normalize(corners[i]), b = normalize(corners[(i + 1) % 4]);
    sum += std::acos(double{dot(a, b)}) * normalize(cross(a, b)).z;
  }
  return std::abs(sum) / 2;
}

void Floor::check_irradiance(double expected, const std::vector<Strategy>& strategies) const {
  // The origin is not on the seam between the floor's two triangles.
  const std::string scene = fmt::format(
      R"(scene:
  materials:
    gray: {{ type: diffuse, reflectance: {} }}
    black: {{ type: diffuse, reflectance: 0 }}
  shapes:
    - {{ type: quad, material: gray, to_world: [ {{ scale: 2 }}, {{ translate: [0.6, 0, 0] }} ] }}
{}  emitters:
{}  sensor:
    type: perspective
    fov: 0.01
    to_world: {{ look_at: {{ origin: [-0.6, 0.1, 0.15], target: [0, 0, 0], up: [0, 0, 1] }} }}
)",
      kReflectance, shapes_, emitters_.empty() ? "    []\n" : emitters_);
  for (const Strategy& strategy : strategies) {
    CAPTURE(strategy.name);
    for (const std::string sampler : kSamplers) {
      CAPTURE(sampler);
      check_value(scene + kFilm +
                      fmt::format("integrator: {{ type: path, max_depth: 2, {} }}\n"
                                  "sampler: {}\n",
                                  strategy.settings, sampler),
                  expected * kReflectance / 3.14159265358979323846);
    }
  }
}

}  // namespace pharos::testing
