// Guided and unguided renders of a scene have the same mean, by the protocol of
// statistics/image_agreement.h. The scenes are variants of hard scenes, with features large enough
// that unguided renders converge. Prints one line per comparison.

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "agreement.h"

namespace pharos::testing {
namespace {

constexpr int kRenders = 32;

/// A guiding method: settings of the integrator's `guiding`, and further settings of the
/// integrator.
struct Method {
  std::string name;
  std::vector<std::string> settings;
  std::vector<std::string> integrator = {};
};

Method focal_learned() {
  return {"focal learned", {"learner=focal", "guider=focal", "mixing=learned"}};
}

Method focal(float unguided_fraction, const char* extent, const char* images) {
  return {fmt::format("focal {} {} {}", unguided_fraction, extent, images),
          {fmt::format("learner={{ type: focal, splat_extent: {} }}", extent), "guider=focal",
           fmt::format("mixing={{ type: fixed, unguided_fraction: {} }}", unguided_fraction),
           fmt::format("training={{ images: {} }}", images)}};
}

/// Returns a pairwise covering array of unguided fractions, extents of splats and uses of training
/// images, and in addition learned fractions.
std::vector<Method> focal_methods() {
  return {focal(0.1f, "line", "discard"),
          focal(0.5f, "roughness_gated", "discard"),
          focal(0.9f, "line", "combine"),
          focal(0.1f, "roughness_gated", "combine"),
          focal(0.5f, "line", "combine"),
          focal(0.9f, "roughness_gated", "discard"),
          focal_learned()};
}

Method gaussians(const char* guider, float unguided_fraction, const char* spatial,
                 const char* images) {
  return {fmt::format("{} {} {} {}", guider, unguided_fraction, spatial, images),
          {fmt::format("learner={{ type: spatial_gaussians, spatial: {} }}", spatial),
           fmt::format("guider={}", guider),
           fmt::format("mixing={{ type: fixed, unguided_fraction: {} }}", unguided_fraction),
           fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
}

Method gaussians_learned() {
  return {"p0 learned",
          {"learner=spatial_gaussians", "guider=p0", "mixing=learned",
           "training={ schedule: geometric }"}};
}

/// Returns a covering array of guiders, unguided fractions, trees or single mixtures, and uses of
/// training images.
std::vector<Method> gaussian_methods() {
  return {gaussians("p0", 0.1f, "kdtree", "discard"),
          gaussians("p0", 0.5f, "single", "combine"),
          gaussians("p0", 0.9f, "kdtree", "combine"),
          gaussians("p1", 0.1f, "single", "combine"),
          gaussians("p1", 0.5f, "kdtree", "discard"),
          gaussians("p1", 0.9f, "single", "discard"),
          gaussians("projected", 0.1f, "kdtree", "combine"),
          gaussians("projected", 0.5f, "single", "discard"),
          gaussians("projected", 0.9f, "kdtree", "discard"),
          gaussians_learned()};
}

Method practical_path_guiding(const char* target, const char* mixing, const char* filters,
                              const char* images) {
  return {
      fmt::format("practical_path_guiding {} {} {}", target, mixing, images),
      {fmt::format(
           "learner={{ type: practical_path_guiding, target: {}, spatial_threshold: 1000, {} }}",
           target, filters),
       "guider=practical_path_guiding", fmt::format("mixing={}", mixing),
       fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
}

/// Returns a covering array of targets, mixing policies, filters, and uses of training images.
std::vector<Method> sd_tree_methods() {
  const char* nearest = "spatial_filter: nearest, directional_filter: nearest";
  const char* smooth = "spatial_filter: stochastic, directional_filter: box";
  const char *few = "{ type: fixed, unguided_fraction: 0.25 }", *half = "fixed";
  const char *kl = "{ type: learned, objective: kl }",
             *variance = "{ type: learned, objective: variance }";
  return {practical_path_guiding("radiance", kl, smooth, "combine"),
          practical_path_guiding("radiance", half, nearest, "discard"),
          practical_path_guiding("radiance", few, smooth, "discard"),
          practical_path_guiding("product", variance, smooth, "discard"),
          practical_path_guiding("product", few, nearest, "combine"),
          practical_path_guiding("relative", kl, nearest, "discard"),
          practical_path_guiding("relative", variance, smooth, "combine")};
}

Method lobes(const char* learner, const char* product, const char* mixing, const char* images) {
  return {fmt::format("vmf {} {} {} {}", learner, product, mixing, images),
          {fmt::format("learner={{ type: parallax_aware_mixtures, {} }}", learner),
           fmt::format("guider={{ type: parallax_aware_mixtures, product: {} }}", product),
           fmt::format("mixing={}", mixing),
           fmt::format("training={{ schedule: uniform, iterations: 8, images: {} }}", images)}};
}

/// Returns a covering array of mixtures, products, mixing policies, and uses of training images.
std::vector<Method> lobe_methods() {
  const char *tree = "spatial: kdtree, cell_samples: 8192", *single = "spatial: single",
             *plain = "parallax: false";
  const char *few = "{ type: fixed, unguided_fraction: 0.1 }", *half = "fixed",
             *learned = "learned";
  return {lobes(tree, "cosine", half, "discard"), lobes(single, "bsdf", few, "discard"),
          lobes(plain, "none", few, "combine"),   lobes(tree, "bsdf", learned, "combine"),
          lobes(single, "none", half, "combine"), lobes(plain, "cosine", learned, "discard"),
          lobes(single, "cosine", few, "combine")};
}

/// Variants: pairs, triplets, triplets that learn from light paths, and triplets that also render
/// with light paths.
enum class Triplets { pairs, plain, light_training, light_always };

Method triplets(Triplets variant, const char* surfaces, float unguided_fraction, bool guide_camera,
                const char* images) {
  constexpr std::array kNames{"pairs", "triplets", "triplets, light in training",
                              "triplets, light always"};
  const bool pairs = variant == Triplets::pairs;
  const bool light = variant == Triplets::light_training || variant == Triplets::light_always;
  Method method{
      fmt::format("{} {} {} {} {}", kNames[static_cast<std::size_t>(variant)], surfaces,
                  unguided_fraction, guide_camera ? "camera" : "pixels", images),
      {fmt::format("learner={{ type: vertex_triplets, vertices: {}, light_paths: {}, cells: 16, "
                   "components: 16, reservoir: 512 }}",
                   pairs ? "pairs" : "triplets", light),
       fmt::format("guider={{ type: vertex_triplets, surfaces: {}, guide_camera: {} }}", surfaces,
                   guide_camera),
       fmt::format("mixing={{ type: fixed, unguided_fraction: {} }}", unguided_fraction),
       fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
  if (light) {
    method.integrator = {"integrator.type=bidirectional",
                         fmt::format("integrator.light_paths={}",
                                     variant == Triplets::light_always ? "always" : "training")};
  }
  return method;
}

/// Returns one half of a pairwise covering array of variants, surface techniques, unguided
/// fractions, guides of first vertices, and uses of training images.
std::vector<Method> triplet_methods(int half) {
  using enum Triplets;
  if (half == 0) {
    return {triplets(pairs, "projected", 0.25f, true, "discard"),
            triplets(plain, "p0", 0.25f, false, "discard"),
            triplets(light_training, "p1", 0.25f, true, "combine"),
            triplets(light_always, "projected", 0.75f, false, "combine"),
            triplets(plain, "projected", 0.75f, true, "combine"),
            triplets(light_always, "p1", 0.25f, true, "discard")};
  }
  return {triplets(pairs, "p0", 0.75f, false, "combine"),
          triplets(pairs, "p1", 0.75f, true, "discard"),
          triplets(plain, "p1", 0.75f, false, "discard"),
          triplets(light_training, "projected", 0.25f, false, "discard"),
          triplets(light_training, "p0", 0.75f, true, "discard"),
          triplets(light_always, "p0", 0.25f, true, "combine")};
}

/// Returns every kind of guide that leaves distances to the media.
std::vector<Method> media_methods() {
  return {focal(0.5f, "line", "discard"),
          focal(0.5f, "roughness_gated", "combine"),
          gaussians("p0", 0.5f, "kdtree", "discard"),
          gaussians("p1", 0.5f, "single", "combine"),
          gaussians("projected", 0.5f, "kdtree", "combine"),
          practical_path_guiding("radiance", "fixed",
                                 "spatial_filter: nearest, directional_filter: nearest", "discard"),
          lobes("spatial: kdtree, cell_samples: 8192", "cosine", "fixed", "discard"),
          lobes("spatial: single", "bsdf", "fixed", "combine")};
}

/// Returns a mixture of `methods` with learned shares of all. The bounds of the shares are as wide
/// as `bounds` says.
Method simplex(const char* name, const char* methods, const char* bounds, const char* images) {
  return {fmt::format("simplex {} {{ {} }} {}", name, bounds, images),
          {fmt::format("methods={}", methods),
           fmt::format("mixing={{ type: simplex, cell_steps: 1024, {} }}", bounds),
           fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
}

/// Returns mixtures of one, two and three methods, with shares near their bounds and with methods
/// that are left out where they are not worth their cost. Triplets steer discrete events.
std::vector<Method> simplex_methods() {
  const char* one = "[ { learner: parallax_aware_mixtures, guider: parallax_aware_mixtures } ]";
  const char* two =
      "[ { learner: { type: vertex_triplets, cells: 16, components: 16, reservoir: 512 }, guider: "
      "vertex_triplets }, { learner: practical_path_guiding, guider: practical_path_guiding } ]";
  const char* three =
      "[ { learner: spatial_gaussians, guider: p0 }, { learner: focal, guider: focal }, { learner: "
      "parallax_aware_mixtures, guider: { type: parallax_aware_mixtures, product: bsdf } } ]";
  return {simplex("three", three, "worth: 1.2", "combine"),
          simplex("one", one, "least: 0.02, unguided: 0.02, explore: 0.5, evidence: 0", "discard"),
          simplex("one", one, "worth: 3, explore: 0", "combine"),
          simplex("two", two, "least: 0.05, unguided: 0.3, worth: 1", "discard")};
}

/// Returns the preset `robust` as it is, and with trainings whose ends depend on what they found.
std::vector<Method> robust_methods() {
  return {
      {"robust", {"=robust"}},
      {"robust, soon settled", {"=robust", ".training.tolerance=0.5", ".training.least_gain=0"}},
      {"robust, short trial", {"=robust", ".training.trial=0.1", ".training.least_gain=0.1"}}};
}

/// A setting of `guiding` begins with the separator that follows `integrator.guiding`, "." if it
/// has none.
LoadedConfig load(const std::filesystem::path& config, const std::vector<std::string>& guiding,
                  std::vector<std::string> overrides = {}) {
  for (const std::string& setting : guiding) {
    const bool is_complete = setting.front() == '=' || setting.front() == '.';
    overrides.push_back((is_complete ? "integrator.guiding" : "integrator.guiding.") + setting);
  }
  return load_render_config(config, overrides, registry());
}

/// The regions are larger than a t-test needs. Unguided renders are so noisy here that smaller
/// regions could not detect a bias of 10 %.
constexpr statistics::AgreementOptions kOptions{.effective_contributions = 500};

/// Compares `methods` with unguided renders with the same number of samples.
void compare(const std::filesystem::path& config, std::span<const Method> methods,
             const std::vector<std::string>& overrides) {
  const std::string scene = config.stem().string();
  const Renders unguided = render_seeds(load(config, {}, overrides), kRenders);
  const auto reference = unguided.side();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    std::vector<std::string> changed = overrides;
    changed.insert(changed.end(), methods[i].integrator.begin(), methods[i].integrator.end());
    const Renders guided =
        render_seeds(load(config, methods[i].settings, changed), kRenders, 1000 * (i + 1));
    const auto result = statistics::compare_images(guided.side(), reference, kOptions);
    CAPTURE(scene);
    CAPTURE(methods[i].name);
    print_agreement(scene + ", " + methods[i].name, guided.samples_per_pixel, result);
    check_agreement(result);
    check_bias_is_seen(guided, reference, kOptions);
  }
}

/// Compares methods on a proof variant with the given changes of its config.
void compare_proof(const std::string& scene, const std::vector<Method>& methods,
                   const std::vector<std::string>& overrides = {}) {
  compare(std::filesystem::path(PHAROS_PROOF_CONFIGS) / (scene + ".yaml"), methods, overrides);
}

/// Compares two shares of unguided samples, for scenes in which unguided renders alone would never
/// converge.
void compare_shares(const std::string& scene, int samples) {
  const auto config = std::filesystem::path(PHAROS_CONFIGS) / (scene + ".yaml");
  const auto render = [&](float unguided_fraction, std::uint64_t first_seed) {
    return render_seeds(
        load(config, focal(unguided_fraction, "line", "discard").settings,
             {"film={ width: 48, height: 32, filter: box }", "integrator.max_depth=8",
              "budget={ spp: " + std::to_string(samples) + " }"}),
        kRenders, first_seed);
  };
  const Renders few = render(0.25f, 1), many = render(0.75f, 1000);
  const auto result = statistics::compare_images(few.side(), many.side(), kOptions);
  CAPTURE(scene);
  print_agreement(scene + ", 0.25 against 0.75", few.samples_per_pixel, result);
  check_agreement(result);
  check_bias_is_seen(few, many.side(), kOptions);
}

}  // namespace

TEST_CASE("unbiased: focal guiding in a camera obscura") {
  compare_proof("camera-obscura", {focal_methods().front()});
}
TEST_CASE("unbiased: spatial Gaussians under strips of light") {
  compare_proof("strip-lights", {gaussian_methods().front()});
}

TEST_CASE("unbiased: an SD-tree under strips of light") {
  compare_proof("strip-lights", {sd_tree_methods().front()});
}

TEST_CASE("unbiased: parallax-aware mixtures under strips of light") {
  compare_proof("strip-lights", {lobe_methods()[3]});
}

TEST_CASE("unbiased: three methods with learned shares under strips of light") {
  compare_proof("strip-lights", {simplex_methods().front()});
}

TEST_CASE("unbiased: robust guiding, whose training ends where it pays no more") {
  compare_proof("standing-light", {robust_methods()[1]});
}

TEST_CASE("unbiased: vertex triplets in fog, with paths from lights") {
  compare_proof("fog-box", {triplet_methods(1).back()});
}

TEST_CASE("unbiased: a guide of spatial Gaussians, by what vertex triplets learned") {
  Method method = triplets(Triplets::plain, "projected", 0.25f, false, "discard");
  method.name = "p1 of triplets";
  method.settings[1] = "guider=p1";
  compare_proof("strip-lights", {method});
}

TEST_CASE("unbiased: every proof variant has a case below") {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(PHAROS_PROOF_CONFIGS)) {
    if (entry.path().extension() == ".yaml") found.push_back(entry.path().stem().string());
  }
  std::sort(found.begin(), found.end());
  CHECK(found == std::vector<std::string>{"camera-obscura", "dining-room", "disco-ball", "fog-box",
                                          "hall", "haze", "living-room", "metalwork",
                                          "mirror-chamber", "pool", "standing-light",
                                          "strip-lights", "volume-caustics"});
}

TEST_CASE("long: unbiased in the proof variant camera-obscura") {
  compare_proof("camera-obscura", focal_methods());
}
TEST_CASE("long: unbiased in the proof variant dining-room") {
  compare_proof("dining-room", focal_methods());
}
TEST_CASE("long: unbiased in the proof variant disco-ball") {
  compare_proof("disco-ball", focal_methods());
}
TEST_CASE("long: unbiased in the proof variant hall") {
  compare_proof("hall", focal_methods());
}
TEST_CASE("long: unbiased in the proof variant living-room") {
  compare_proof("living-room", focal_methods());
}

TEST_CASE("long: spatial Gaussians are unbiased in the proof variant living-room") {
  compare_proof("living-room", gaussian_methods());
}
TEST_CASE("long: spatial Gaussians are unbiased in the proof variant standing-light") {
  compare_proof("standing-light", gaussian_methods());
}
TEST_CASE("long: spatial Gaussians are unbiased in the proof variant strip-lights") {
  compare_proof("strip-lights", gaussian_methods());
}

TEST_CASE("long: learned shares are unbiased in the proof variant strip-lights") {
  compare_proof("strip-lights", simplex_methods());
}
TEST_CASE("long: learned shares are unbiased in the proof variant metalwork") {
  compare_proof("metalwork", simplex_methods());
}
TEST_CASE("long: learned shares are unbiased in the proof variant haze") {
  compare_proof("haze", simplex_methods());
}

TEST_CASE("long: robust guiding is unbiased in the proof variant standing-light") {
  compare_proof("standing-light", robust_methods());
}
TEST_CASE("long: robust guiding is unbiased in the proof variant mirror-chamber") {
  compare_proof("mirror-chamber", robust_methods());
}
TEST_CASE("long: robust guiding is unbiased in the proof variant pool") {
  compare_proof("pool", robust_methods());
}

TEST_CASE("long: SD-trees are unbiased in the proof variant camera-obscura") {
  // Twice the samples are necessary, because cells and leaves that have not found the pinhole cause
  // bright outliers.
  compare_proof("camera-obscura", sd_tree_methods(), {"budget={ spp: 128 }"});
}
TEST_CASE("long: SD-trees are unbiased in the proof variant hall") {
  compare_proof("hall", sd_tree_methods());
}
TEST_CASE("long: SD-trees are unbiased in the proof variant living-room") {
  compare_proof("living-room", sd_tree_methods());
}
TEST_CASE("long: SD-trees are unbiased in the proof variant strip-lights") {
  compare_proof("strip-lights", sd_tree_methods());
}

TEST_CASE("long: parallax-aware mixtures are unbiased in the proof variant camera-obscura") {
  compare_proof("camera-obscura", lobe_methods());
}
TEST_CASE("long: parallax-aware mixtures are unbiased in the proof variant hall") {
  compare_proof("hall", lobe_methods());
}
TEST_CASE("long: parallax-aware mixtures are unbiased in the proof variant living-room") {
  compare_proof("living-room", lobe_methods());
}
TEST_CASE("long: parallax-aware mixtures are unbiased in the proof variant strip-lights") {
  compare_proof("strip-lights", lobe_methods());
}

TEST_CASE("long: unbiased in media, in the proof variant fog-box") {
  compare_proof("fog-box", media_methods());
}
TEST_CASE("long: unbiased in media, in the proof variant haze") {
  compare_proof("haze", media_methods());
}
TEST_CASE("long: unbiased in media, in the proof variant volume-caustics") {
  compare_proof("volume-caustics", media_methods());
}

TEST_CASE("long: vertex triplets are unbiased in the proof variant metalwork") {
  compare_proof("metalwork", triplet_methods(0));
}
TEST_CASE("long: vertex triplets are unbiased in the proof variant mirror-chamber") {
  compare_proof("mirror-chamber", triplet_methods(1));
}
TEST_CASE("long: vertex triplets are unbiased in the proof variant pool") {
  compare_proof("pool", triplet_methods(0), {"budget={ spp: 96 }"});
}
TEST_CASE("long: vertex triplets are unbiased in the proof variant fog-box") {
  compare_proof("fog-box", triplet_methods(1));
}
TEST_CASE("long: vertex triplets are unbiased in the proof variant haze") {
  compare_proof("haze", triplet_methods(0), {"budget={ spp: 64 }"});
}
TEST_CASE("long: vertex triplets are unbiased in the proof variant volume-caustics") {
  compare_proof("volume-caustics", triplet_methods(1));
}

// The smallest pinhole is left out, because with so few samples most renders do not find it.
TEST_CASE("long: unbiased with any share of guiding in camera-obscura") {
  compare_shares("camera-obscura", 512);
}
TEST_CASE("long: unbiased with any share of guiding in camera-obscura-large") {
  compare_shares("camera-obscura-large", 256);
}
TEST_CASE("long: unbiased with any share of guiding in hall") {
  compare_shares("hall", 512);
}

}  // namespace pharos::testing
