// Media with known closed forms: transmitted light, light that is scattered once, and white
// furnaces, in which purely scattering fog is invisible.

#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/statistics/quadrature.h>

#include "analytic.h"

namespace pharos::testing {
namespace {

constexpr double kPi64 = 3.14159265358979323846;

double mean_of(double r, double g, double b) {
  return (r + g + b) / 3;
}

/// A camera at the origin with a tiny field of view, which looks along +z.
const std::string kNeedle =
    "  sensor: { type: perspective, fov: 0.01, to_world: { look_at: { origin: [0, 0, 0], target: "
    "[0, 0, 1], up: [0, 1, 0] } } }\n";

TEST_CASE("media: what gets through two nested boxes of other media") {
  // A slab from z = 1 to 2, which contains another slab from z = 1.25 to 1.5.
  const auto scene = [](const char* scattering, const char* absorption) {
    return fmt::format(
        R"(scene:
  media:
    outer: {{ type: homogeneous, scattering: [0.3, 1, 2], absorption: 0 }}
    inner: {{ type: homogeneous, scattering: {}, absorption: {} }}
  shapes:
    - {{ type: box, material: pass_through, interior: outer, to_world: [ {{ scale: [1, 1, 0.5] }}, {{ translate: [0, 0, 1.5] }} ] }}
    - {{ type: box, material: pass_through, interior: inner, exterior: outer, to_world: [ {{ scale: [1, 1, 0.125] }}, {{ translate: [0, 0, 1.375] }} ] }}
    - {{ type: quad, material: {{ type: diffuse, reflectance: 0 }}, emitter: {{ type: area, radiance: 2 }}, to_world: [ {{ rotate: {{ axis: [1, 0, 0], degrees: 180 }} }}, {{ translate: [0, 0, 3] }} ] }}
{})",
        scattering, absorption, kNeedle);
  };
  const auto left = [](double outer, double inner) {
    return 2 * std::exp(-0.75 * outer - 0.25 * inner);
  };
  const double expected = mean_of(left(0.3, 4), left(1, 0), left(2, 1));
  for (const auto& fog :
       {std::pair{"[4, 0, 1]", "0"}, {"[1, 0, 0.5]", "[3, 0, 0.5]"}, {"0", "[4, 0, 1]"}}) {
    const char *scattering = fog.first, *absorption = fog.second;
    CAPTURE(scattering);
    check_value(scene(scattering, absorption) + kFilm +
                    "integrator: { type: path, max_depth: 1 }\nsampler: independent\n",
                expected);
  }
}

TEST_CASE("media: every channel has its own coefficients") {
  const RenderResult result = render(R"(scene:
  media:
    glass: { type: homogeneous, scattering: 0, absorption: [0.1, 1, 2] }
  shapes:
    - { type: box, material: pass_through, interior: glass, to_world: { translate: [0, 0, 3] } }
  emitters: [ { type: constant, radiance: 1 } ]
)" + kNeedle + kFilm + "integrator: { type: path, max_depth: 1 }\nbudget: { spp: 1 }\n");
  for (const auto& [channel, sigma] : {std::pair{"R", 0.1}, {"G", 1.0}, {"B", 2.0}}) {
    const float value = result.image.pixel(4, 4)[result.image.channel_index(channel)];
    CHECK(value == doctest::Approx(std::exp(-2 * sigma)).epsilon(1e-4));
  }
}

/// A spot of a floor and a camera at height 0.8, both inside a ball of a medium that only absorbs.
std::string spot_in_box(const std::string& lights) {
  return R"(scene:
  media:
    smoke: { type: homogeneous, scattering: 0, absorption: [0.2, 0.5, 1] }
  shapes:
    - { type: quad, material: { type: diffuse, reflectance: 0.5 }, to_world: { translate: [0.3, 0.2, 0] } }
    - { type: sphere, radius: 2, material: pass_through, interior: smoke }
)" + lights +
         R"(
  sensor: { type: perspective, fov: 0.01, to_world: { look_at: { origin: [-0.6, 0, 0.8], target: [0, 0, 0], up: [0, 0, 1] } } }
  medium: smoke
)";
}

TEST_CASE("media: lights are seen through boundaries, by samples and by chance alike") {
  // From the spot on the floor, every way out of the ball has length 2. The way to the camera has
  // length 1.
  const auto left = [](double sigma) { return std::exp(-3 * sigma); };
  const double share = 0.5 * mean_of(left(0.2), left(0.5), left(1));
  for (const Strategy& strategy : kStrategies) {
    CAPTURE(strategy.name);
    check_value(spot_in_box("  emitters: [ { type: constant, radiance: 1 } ]") + kFilm +
                    fmt::format("integrator: {{ type: path, max_depth: 2, {} }}\n"
                                "sampler: independent\n",
                                strategy.settings),
                share);
  }
  // A point light at height 3, outside the boundary.
  check_value(spot_in_box("  emitters: [ { type: point, intensity: 9, position: [0, 0, 3] } ]") +
                  kFilm + "integrator: { type: path, max_depth: 2 }\nsampler: independent\n",
              share / kPi64);
}

TEST_CASE("media: light that is scattered once") {
  // A lamp at distance 1 from the middle of the line of sight, in infinite fog.
  struct Fog {
    const char* phase;
    double g;
  };
  for (const Fog& fog : {Fog{"isotropic", 0},
                         {"{ type: henyey_greenstein, g: 0.7 }", 0.7},
                         {"{ type: henyey_greenstein, g: -0.4 }", -0.4}}) {
    const char* phase = fog.phase;
    CAPTURE(phase);
    const auto seen = [g = fog.g](double scattering, double absorption) {
      const auto at = [&](double t, double) {
        const double away = std::hypot(t - 1, 1.0), sigma = scattering + absorption;
        // Light travels from the lamp to the line and then to the camera, along -z.
        const double cosine = (t - 1) / away * -1;
        const double p = (1 - g * g) / (4 * kPi64 * std::pow(1 + g * g - 2 * g * cosine, 1.5));
        return scattering * p * std::exp(-sigma * (t + away)) / (away * away);
      };
      return statistics::integrate(at, {0, 60, 0, 1}, {.tolerance = 1e-9}).value;
    };
    const double expected = mean_of(seen(0.5, 0.1), seen(0.2, 0), seen(1, 0.5));
    const std::string scene = fmt::format(
        R"(scene:
  media:
    fog: {{ type: homogeneous, scattering: [0.5, 0.2, 1], absorption: [0.1, 0, 0.5], phase: {} }}
  emitters: [ {{ type: point, intensity: 1, position: [1, 0, 1] }} ]
{}  medium: fog
)",
        phase, kNeedle);
    for (const std::string sampler : kSamplers) {
      check_value(
          scene + kFilm + "integrator: { type: path, max_depth: 2 }\nsampler: " + sampler + "\n",
          expected);
    }
  }
}

TEST_CASE("media: a white furnace shows no fog that only scatters") {
  for (const char* phase :
       {"isotropic", "rayleigh", "{ type: henyey_greenstein, g: 0.8 }",
        "{ type: henyey_greenstein, g: -0.6 }", "{ type: henyey_greenstein, g: 0.98 }"}) {
    CAPTURE(phase);
    for (const bool inside : {true, false}) {
      CAPTURE(inside);
      const std::string scene = fmt::format(
          R"(scene:
  media:
    fog: {{ type: homogeneous, scattering: [0.5, 1, 3], phase: {} }}
  shapes:
    - {{ type: sphere, radius: 1, material: pass_through, interior: fog }}
    - {{ type: sphere, center: [0, 0, 0.6], radius: 0.2, material: {{ type: dielectric, ior: 1.5 }}, exterior: fog }}
  emitters: [ {{ type: constant, radiance: 1 }} ]
  sensor: {{ type: perspective, fov: 30, to_world: {{ look_at: {{ origin: [0, 0, {}], target: [0, 0, 1], up: [0, 1, 0] }} }} }}
{})",
          phase, inside ? "-0.3" : "-4", inside ? "  medium: fog\n" : "");
      for (const char* nee : {"true", "false"}) {
        check_value(scene + kFilm +
                        fmt::format("integrator: {{ type: path, max_depth: 200, "
                                    "next_event_estimation: {} }}\nsampler: independent\n",
                                    nee),
                    1);
      }
    }
  }
}

}  // namespace
}  // namespace pharos::testing
