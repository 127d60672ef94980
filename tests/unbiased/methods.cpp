#include "methods.h"

#include <array>

#include <fmt/format.h>

namespace pharos::testing {
namespace {

/// Densities by part of space, with learned shares.
Method focal_learned() {
  return {"focal local learned",
          {"learner={ type: focal, local_cells: 3 }", "guider=focal", "mixing=learned"}};
}

Method gaussians(const char* guider, float unguided_fraction, const char* spatial,
                 const char* images) {
  return {fmt::format("{} {} {} {}", guider, unguided_fraction, spatial, images),
          {fmt::format("learner={{ type: spatial_gaussians, spatial: {} }}", spatial),
           fmt::format("guider={}", guider),
           fmt::format("mixing={{ type: fixed, unguided_fraction: {} }}", unguided_fraction),
           fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
}

/// Choices between guide and BSDF that keep the numbers of both evenly spread.
Method focal_with_ordered_choices() {
  Method method = focal(0.5f, "line", "combine");
  method.name += ", ordered choices";
  method.others = {
      "sampler={ type: aligned, angles: [30], samples: 64, purposes: [bsdf_direction], "
      "ordered_choice: true }"};
  return method;
}

Method gaussians_learned() {
  return {"p0 learned",
          {"learner=spatial_gaussians", "guider=p0", "mixing=learned",
           "training={ schedule: geometric }"}};
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

Method lobes(const char* learner, const char* product, const char* mixing, const char* images) {
  return {fmt::format("vmf {} {} {} {}", learner, product, mixing, images),
          {fmt::format("learner={{ type: parallax_aware_mixtures, {} }}", learner),
           fmt::format("guider={{ type: parallax_aware_mixtures, product: {} }}", product),
           fmt::format("mixing={}", mixing),
           fmt::format("training={{ schedule: uniform, iterations: 8, images: {} }}", images)}};
}

/// Returns a mixture of `methods` with learned shares of all. The bounds of the shares are as wide
/// as `bounds` says.
Method simplex(const char* name, const char* methods, const char* bounds, const char* images) {
  return {fmt::format("simplex {} {{ {} }} {}", name, bounds, images),
          {fmt::format("methods={}", methods),
           fmt::format("mixing={{ type: simplex, cell_steps: 1024, {} }}", bounds),
           fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
}

/// A termination with its settings, on one line.
struct Ending {
  std::string name, settings;
  bool learns = false;
};

/// Returns every termination, so that many paths end or split: from the first vertex on, and after
/// few samples.
std::vector<Ending> endings() {
  return {{"none", "none"},
          {"throughput", "{ type: throughput, depth: 2 }"},
          {"adjoint",
           "{ type: adjoint, window: 1.5, depth: 1, cell_steps: 2000, least_steps: 200 }", true},
          {"efficiency", "{ type: efficiency, cell_steps: 2000, least_steps: 200 }", true}};
}

Method with_termination(Method method, const Ending& ending) {
  method.name += ", " + ending.name;
  method.others.push_back("integrator.termination=" + ending.settings);
  return method;
}

}  // namespace

Method focal(float unguided_fraction, const char* extent, const char* images) {
  return {fmt::format("focal {} {} {}", unguided_fraction, extent, images),
          {fmt::format("learner={{ type: focal, splat_extent: {} }}", extent), "guider=focal",
           fmt::format("mixing={{ type: fixed, unguided_fraction: {} }}", unguided_fraction),
           fmt::format("training={{ images: {} }}", images)}};
}

std::vector<Method> focal_methods() {
  return {focal(0.1f, "line", "discard"),
          focal(0.5f, "roughness_gated", "discard"),
          focal(0.9f, "line", "combine"),
          focal(0.1f, "roughness_gated", "combine"),
          focal(0.5f, "line", "combine"),
          focal(0.9f, "roughness_gated", "discard"),
          focal_learned(),
          focal_with_ordered_choices()};
}

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
          gaussians("{ type: p0, product: bsdf }", 0.25f, "kdtree, splat: true", "combine"),
          gaussians("{ type: p1, product: none }", 0.25f, "kdtree, splat: true", "discard"),
          gaussians_learned()};
}

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

std::vector<Method> lobe_methods() {
  const char *tree = "spatial: kdtree, cell_samples: 8192",
             *splatted = "spatial: kdtree, cell_samples: 8192, splat: true",
             *single = "spatial: single", *plain = "parallax: false";
  const char *few = "{ type: fixed, unguided_fraction: 0.1 }", *half = "fixed",
             *learned = "learned";
  return {lobes(tree, "cosine", half, "discard"),  lobes(single, "bsdf", few, "discard"),
          lobes(plain, "none", few, "combine"),    lobes(tree, "bsdf", learned, "combine"),
          lobes(single, "none", half, "combine"),  lobes(plain, "cosine", learned, "discard"),
          lobes(single, "cosine", few, "combine"), lobes(splatted, "bsdf", few, "combine")};
}

/// Variants: pairs, whose cells are divided by counts; triplets, whose cells are divided by
/// effective numbers; triplets that learn from light paths, and triplets that also render with
/// light paths.
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
                   "components: 16, reservoir: 512, least_effective: {} }}",
                   pairs ? "pairs" : "triplets", light, pairs ? 0 : 64),
       fmt::format("guider={{ type: vertex_triplets, surfaces: {}, guide_camera: {} }}", surfaces,
                   guide_camera),
       fmt::format("mixing={{ type: fixed, unguided_fraction: {} }}", unguided_fraction),
       fmt::format("training={{ schedule: geometric, images: {} }}", images)}};
  if (light) {
    method.others = {"integrator.type=bidirectional",
                     fmt::format("integrator.light_paths={}",
                                 variant == Triplets::light_always ? "always" : "training")};
  }
  return method;
}

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

std::vector<Method> resampled_methods() {
  const auto with_candidates = [](Method method, int candidates) {
    method.name += fmt::format(", {} candidates", candidates);
    method.settings.push_back(fmt::format("candidates={}", candidates));
    return method;
  };
  return {
      with_candidates(lobes("spatial: kdtree, cell_samples: 8192", "none", "fixed", "combine"), 4),
      with_candidates(gaussians("p0", 0.1f, "kdtree", "discard"), 8),
      with_candidates(
          practical_path_guiding("radiance", "learned", "spatial_filter: nearest", "combine"), 2),
      with_candidates(simplex_methods().front(), 16)};
}

std::vector<Method> adaptive_methods() {
  const std::vector<std::string> adaptive{
      "learner=uniform", "guider=uniform", "mixing={ type: fixed, unguided_fraction: 0.9 }",
      "training={ iterations: 2, share: 0.25, pixels: adaptive }"};
  return {{"adaptive pixels", adaptive},
          {"adaptive pixels, paths from both ends", adaptive, {"integrator.type=bidirectional"}}};
}

std::vector<Method> robust_methods() {
  return {
      {"robust", {"=robust"}},
      {"robust, soon settled", {"=robust", ".training.tolerance=0.5", ".training.least_gain=0"}},
      {"robust, short trial", {"=robust", ".training.trial=0.1", ".training.least_gain=0.1"}},
      {"robust, methods left out",
       {"=robust", ".training.trial=0.01", ".training.least_gain=0", ".training.least_part=10"}}};
}

std::vector<Method> termination_methods() {
  std::vector<Method> methods;
  for (const Ending& ending : endings()) {
    if (ending.name == "none") continue;  // this is what all methods are compared with
    Method unguided{"unguided", {}};
    if (ending.learns) {
      unguided.others.push_back("integrator.training={ schedule: uniform, iterations: 8 }");
    }
    methods.push_back(with_termination(unguided, ending));
  }
  const std::vector<Method> guides{focal(0.5f, "line", "combine"), sd_tree_methods().front(),
                                   lobe_methods().front(), robust_methods().front()};
  for (const Method& guide : guides) {
    for (const Ending& ending : endings()) methods.push_back(with_termination(guide, ending));
  }
  return methods;
}

}  // namespace pharos::testing
