// Irradiance of light that comes through a hole, rendered by guided path tracing.

#include <tuple>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "analytic.h"

namespace pharos::testing {
namespace {

/// Returns a black wall at height `h` with a square hole of half-edge `r` about `x`. A lamp of
/// radiance 3 above the wall fills everything that is visible through the hole.
std::string wall_with_hole(double h, double r, double x) {
  constexpr double kFar = 1;
  const auto plate = [&](double x0, double x1, double y0, double y1) {
    return fmt::format(
        "    - {{ type: quad, material: black, to_world: [ {{ scale: [{}, {}, 1] }}, "
        "{{ translate: [{}, {}, {}] }} ] }}\n",
        (x1 - x0) / 2, (y1 - y0) / 2, (x0 + x1) / 2, (y0 + y1) / 2, h);
  };
  return plate(-kFar, x - r, -kFar, kFar) + plate(x + r, kFar, -kFar, kFar) +
         plate(x - r, x + r, -kFar, -r) + plate(x - r, x + r, r, kFar) +
         fmt::format(
             "    - {{ type: quad, material: black, emitter: {{ type: area, radiance: 3 }}, "
             "to_world: [ {{ scale: 0.6 }}, {{ rotate: {{ axis: [1, 0, 0], degrees: 180 }} }}, "
             "{{ translate: [{}, 0, {}] }} ] }}\n",
             1.2 * x, 1.2 * h);
}

}  // namespace

TEST_CASE("a light seen through a hole, guided") {
  const double h = 0.5, r = 0.06, x = 0.1;
  const auto hole = Transform::translate({static_cast<float>(x), 0, static_cast<float>(h)}) *
                    Transform::scale({static_cast<float>(r), static_cast<float>(r), 1});
  std::vector<Strategy> strategies;
  for (const auto& [fraction, extent, mis] :
       {std::tuple{0.1, "line", "balance"}, {0.25, "roughness_gated", "power"}}) {
    strategies.push_back(
        {fmt::format("focal {} {} {}", fraction, extent, mis),
         fmt::format("mis: {}, guiding: {{ learner: {{ type: focal, splat_extent: {} }}, "
                     "guider: focal, mixing: {{ type: fixed, unguided_fraction: {} }}, "
                     "training: {{ share: 0.2 }} }}",
                     mis, extent, fraction)});
  }
  Floor(wall_with_hole(h, r, x), "").check_irradiance(3 * polygon_irradiance(hole), strategies);
}

}  // namespace pharos::testing
