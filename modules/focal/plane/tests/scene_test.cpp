#include "../scene.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "angle_fit.h"

namespace pharos::focal::plane {

using testing::integrate;

namespace {

/// Computes the irradiance by tracing rays, independently of the closed form.
double traced_irradiance(const GapScene& scene, double x) {
  const auto radiance_times_cosine = [&](double angle) {
    return scene.sees_light(x, angle) ? std::cos(angle) : 0.0;
  };
  return integrate(radiance_times_cosine, -std::numbers::pi / 2, std::numbers::pi / 2, 1'000'000);
}

}  // namespace

TEST_CASE("gap scene: the closed form of the irradiance equals the traced one") {
  GapScene scene;
  for (const double light : {1.5, 0.6}) {  // the obstacle hides the smaller light from some points
    scene.light_half_width = light;
    for (const double x : {-1.0, -0.37, 0.0, 0.2, 0.85}) {
      CAPTURE(light);
      CAPTURE(x);
      CHECK(scene.irradiance(x) == doctest::Approx(traced_irradiance(scene, x)).epsilon(1e-3));
    }
  }
}

TEST_CASE("gap scene: below a single gap the irradiance is twice the sine of half its angle") {
  const GapScene scene{.gap_count = 1, .gap_width = 0.3};
  CHECK(scene.irradiance(0) == doctest::Approx(2 * 0.15 / std::hypot(0.15, 0.5)));
}

TEST_CASE("gap scene: every point of the floor sees the light through every gap") {
  const GapScene scene;
  for (const double x : {-1.0, -0.5, 0.0, 0.7, 1.0}) CHECK(scene.lit_angles(x).size() == 3);
  GapScene smaller = scene;
  smaller.light_half_width = 1.1;
  CHECK(smaller.lit_angles(1.0).size() == 2);  // through the leftmost gap, x1 would be -1.4
}

TEST_CASE("gap scene: the mean irradiance of one gap in closed form") {
  const GapScene scene{.gap_count = 1};
  // The integral of the sine over x is the difference of the distances to the gap's edge.
  const auto distances = [](double edge) {
    return std::hypot(edge + 1, 0.5) - std::hypot(edge - 1, 0.5);
  };
  const double mean = (distances(0.005) - distances(-0.005)) / 2;
  CHECK(scene.mean_irradiance() == doctest::Approx(mean).epsilon(1e-6));
}

}  // namespace pharos::focal::plane
