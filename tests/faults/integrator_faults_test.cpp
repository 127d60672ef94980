// A table of faults against furnaces. Each fault planted into an integrator must fail exactly those
// furnaces that exercise the faulty formula.

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "../contracts/furnace.h"

namespace pharos::testing {
namespace {

/// A furnace with an exact answer for the mean of all pixels.
struct Furnace {
  std::string name, scene, settings;
  double answer;
  std::string integrator = "path";
  int spp = 32;
};

/// An emitting square that covers half the height and half the width of the view.
const std::string kCoveredScene = R"(
scene:
  shapes:
    - { type: quad, to_world: [ { scale: 0.5 }, { rotate: { axis: [0, 1, 0], degrees: 180 } }, { translate: [0.1, 0.2, 1] } ],
        material: { type: diffuse, reflectance: 0 }, emitter: { type: area, radiance: 1 } }
  sensor: { type: perspective, fov: 90 }
film: { width: 33, height: 33, filter: box }
)";

/// Walls that reflect 0.8 and emit 1, so every pixel shows 1 / (1 - 0.8).
const std::string kRouletteScene = R"(
scene:
  materials:
    wall: { type: diffuse, reflectance: 0.8 }
  shapes:
    - { type: sphere, radius: 1, flip_normals: true, material: wall, emitter: { type: area, radiance: 1 } }
  sensor: { type: perspective, fov: 60, to_world: { translate: [0.2, 0.1, -0.3] } }
film: { width: 32, height: 32, filter: box }
)";

/// A square of reflectance one half, seen from above, under a white sky. A black screen hides half
/// of the sky, so steps from the square find light half of the time, and each pixel shows 1/4.
constexpr double kHalfLit = 0.25;
const std::string kHalfLitScene = R"(
scene:
  shapes:
    - { type: quad, material: { type: diffuse, reflectance: 0.5 }, to_world: [ { scale: 0.1 }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ] }
    - { type: quad, material: { type: diffuse, reflectance: 0 }, to_world: [ { scale: 10000 }, { rotate: { axis: [0, 1, 0], degrees: 90 } }, { translate: [-1, 0, 0] } ] }
  emitters: [ { type: constant, radiance: 1 } ]
  sensor: { type: orthographic, width: 0.1, to_world: { look_at: { origin: [1, 100, 0], target: [0, 0, 0], up: [0, 0, 1] } } }
film: { width: 16, height: 16, filter: box }
)";

/// A ball of fog that only scatters, under a white sky. It is invisible.
const std::string kFogBallScene = R"(
scene:
  media:
    fog: { type: stub_gray, scattering: 0.3 }
  shapes:
    - { type: sphere, radius: 1, material: pass_through, interior: fog }
  emitters: [ { type: constant, radiance: 1 } ]
  sensor: { type: perspective, fov: 40, to_world: { translate: [0.2, 0.1, -2.5] } }
film: { width: 32, height: 32, filter: box }
)";

std::vector<Furnace> furnaces() {
  const std::string guiding =
      "max_depth: 4, guiding: { learner: stub_direction, guider: stub_direction, "
      "training: { iterations: 3 } }";
  return {
      {"unguided", kDiffuseScene, "max_depth: 4", kDiffuseFurnace},
      {"guided", kDiffuseScene, guiding, kDiffuseFurnace},
      {"half covered", kCoveredScene, "max_depth: 2", 0.25},
      {"roulette", kRouletteScene, "max_depth: 200, roulette: throughput, roulette_depth: 2", 5},
      {"glass in fog", kGlassInFogScene, "max_depth: 100", kGlassInFogFurnace},
      {"ball of fog", kFogBallScene, "max_depth: 100", 1},
      {"light", kDiffuseScene, "max_depth: 4", kDiffuseFurnace, "light", 128},
      {"both", kDiffuseScene, "max_depth: 4", kDiffuseFurnace, "bidirectional"},
      {"both in fog", kGlassInFogScene, "max_depth: 100", kGlassInFogFurnace, "bidirectional"},
      {"both, ball of fog", kFogBallScene, "max_depth: 100", 1, "bidirectional"}};
}

/// Furnaces for mixtures: two methods with learned shares, and steps chosen among candidates.
std::vector<Furnace> mixed_furnaces() {
  return {
      {"shares", kDiffuseScene,
       "max_depth: 4, guiding: { methods: [ { learner: stub_direction, guider: stub_direction }, "
       "{ learner: uniform, guider: uniform } ], mixing: { type: simplex, evidence: 0, worth: 3 "
       "}, training: { schedule: geometric } }",
       kDiffuseFurnace},
      {"candidates", kDiffuseScene,
       "max_depth: 4, guiding: { learner: stub_direction, guider: stub_direction, candidates: 4, "
       "training: { "
       "iterations: 3 } }",
       kDiffuseFurnace}};
}

/// Furnaces in which paths split, in which they survive roulette before a step is drawn, and in
/// which light samples split.
std::vector<Furnace> split_furnaces() {
  return {
      {"split", kDiffuseScene, "max_depth: 4, termination: { type: stub_factor, factor: 2.5 }",
       kDiffuseFurnace},
      {"ended", kDiffuseScene, "max_depth: 4, termination: { type: stub_factor, factor: 0.6 }",
       kDiffuseFurnace},
      {"lights", kDiffuseScene,
       "max_depth: 4, termination: { type: stub_factor, factor: 1, lights: 2.5 }", kDiffuseFurnace},
      {"whole", kDiffuseScene, "max_depth: 4", kDiffuseFurnace}};
}

/// Returns the config of a furnace with a fault.
std::string config_of(const Furnace& furnace, const std::string& fault) {
  return furnace.scene + fmt::format(
                             "integrator: {{ type: faulty_{}, fault: {}, settings: {{ {} }} }}\n"
                             "sampler: independent\nbudget: {{ spp: {} }}\n",
                             furnace.integrator, fault, furnace.settings, furnace.spp);
}

/// Returns whether the test of a furnace fails under a fault.
bool turns_red(const Furnace& furnace, const std::string& fault) {
  return std::abs(furnace_t(config_of(furnace, fault), furnace.answer)) > kLimit;
}

/// Returns the mean variance of the pixels of a furnace, as they scatter about its answer.
double variance_of_pixels(const Furnace& furnace, const std::string& fault) {
  const Image image = render(config_of(furnace, fault)).image;
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double error = mean(image.rgb(x, y)) - furnace.answer;
      sum += error * error;
    }
  }
  return sum / (image.width() * image.height());
}

void check_row(const std::string& fault, const std::vector<bool>& expected,
               const std::vector<Furnace>& all = furnaces()) {
  REQUIRE(expected.size() <= all.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(fault);
    CAPTURE(all[i].name);
    CHECK(turns_red(all[i], fault) == expected[i]);
  }
}

constexpr bool red = true;
constexpr bool green = false;

}  // namespace

// A row lists the expected results for the first furnaces, or for all of them, in the order of
// furnaces(). Path tracing: unguided, guided, half covered, roulette, glass in fog, ball of fog.
// Light tracing: the diffuse furnace. Bidirectional path tracing: the diffuse furnace, glass in
// fog, ball of fog.

TEST_CASE("no fault") {
  check_row("none", {green, green, green, green, green, green, green, green, green, green});
}
TEST_CASE("fault: emission is weighted without the guide's density") {
  check_row("mis_without_guide", {green, red, green, green, green, green});
}
TEST_CASE("fault: samples of value zero are dropped") {
  check_row("zero_samples_dropped", {green, green, red, green, green, green});
}
TEST_CASE("fault: the probability of the light is forgotten") {
  check_row("light_choice_forgotten",
            {red, red, green, green, green, green, green, red, green, green});
}
TEST_CASE("fault: survivors of roulette are not weighted") {
  check_row("roulette_unweighted", {green, green, green, red, green, green});
}
TEST_CASE("fault: the density of distances is forgotten") {
  check_row("distance_density_forgotten",
            {green, green, green, green, red, red, green, green, red, red});
}
TEST_CASE("fault: light does not get through boundaries of media") {
  check_row("boundaries_cast_shadows",
            {green, green, green, green, green, red, green, green, green, red});
}
TEST_CASE("fault: shining surfaces seen from the lens are not foreshortened") {
  check_row("camera_cosine_forgotten",
            {green, green, green, green, green, green, red, red, red, green});
}
TEST_CASE("fault: paths from the lens ignore the light paths that make them too") {
  check_row("reverse_density_forgotten",
            {green, green, green, green, green, green, green, red, red, red});
}

TEST_CASE("faults of mixtures") {
  check_row("none", {green, green}, mixed_furnaces());
  check_row("shares_forgotten", {red, green}, mixed_furnaces());
  check_row("shares_learned_too_early", {red, red}, mixed_furnaces());
  check_row("resampling_unweighted", {green, red}, mixed_furnaces());
}

TEST_CASE("faults of branches") {
  check_row("none", {green, green, green, green}, split_furnaces());
  check_row("branches_unweighted", {red, red, red, green}, split_furnaces());
}

TEST_CASE("fault: branches share random numbers, so splitting lowers no noise") {
  const auto quotient = [](const std::string& fault) {
    const std::string settings = "max_depth: 2, next_event_estimation: false";
    const Furnace whole{"whole", kHalfLitScene, settings, kHalfLit};
    const Furnace split{"split", kHalfLitScene,
                        settings + ", termination: { type: stub_factor, factor: 16 }", kHalfLit};
    return variance_of_pixels(split, fault) / variance_of_pixels(whole, fault);
  };
  CHECK(quotient("none") < 0.1);
  CHECK(quotient("branches_share_numbers") > 0.9);
}

}  // namespace pharos::testing
