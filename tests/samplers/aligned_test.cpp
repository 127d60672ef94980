// Tests of renders with the sampler `aligned`. They have the same mean as renders with independent
// random numbers, the same bits for any number of threads, and less variance if the integrand has
// edges.

#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/statistics/hypothesis.h>

#include "agreement.h"
#include "renders.h"

namespace pharos::testing {
namespace {

/// Two square lights with a slanted board in front of one of them, seen through a wide lens.
constexpr const char* kBoard = R"(
scene:
  shapes:
    - { type: quad, to_world: [ { scale: [4, 4, 1] }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ], material: { type: diffuse, reflectance: 0.6, warp: octahedral } }
    - { type: quad, to_world: [ { scale: [2, 0.5, 1] }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { rotate: { axis: [0, 1, 0], degrees: 35 } }, { translate: [0.3, 1, 0.6] } ], material: { type: two_sided, bsdf: { type: diffuse, reflectance: 0.2 } } }
    - { type: quad, to_world: [ { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 3, 0] } ], emitter: { type: area, radiance: 8 } }
    - { type: quad, to_world: [ { scale: 0.3 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [2, 2.5, 1] } ], emitter: { type: area, radiance: 10 } }
  sensor: { type: thin_lens, aperture_radius: 0.1, focus_distance: 5, fov: 40, to_world: { look_at: { origin: [0, 2, -5], target: [0, 0, 0], up: [0, 1, 0] } } }
integrator: { type: path, max_depth: 3, light_selection: all }
)";

/// A floor in the penumbra of a slanted edge. The light is so small that BSDF samples seldom find
/// it. The edge of the light therefore causes the noise.
constexpr const char* kPenumbra = R"(
scene:
  shapes:
    - { type: quad, to_world: [ { scale: 4 }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ] }
    - { type: quad, to_world: [ { scale: 2 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [2, 0, 0] }, { rotate: { axis: [0, 1, 0], degrees: 35 } }, { translate: [0, 2, 0] } ] }
    - { type: quad, to_world: [ { scale: 0.3 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 3, 0] } ], emitter: { type: area, radiance: 50 } }
  sensor: { type: perspective, fov: 30, to_world: { look_at: { origin: [0, 1, -0.4], target: [0, 0, 0], up: [0, 1, 0] } } }
integrator: { type: path, max_depth: 2, light_selection: all }
)";

std::string config(const std::string& scene, const std::string& sampler, int spp) {
  return scene + fmt::format(
                     "film: {{ width: 32, height: 32, filter: box }}\n"
                     "sampler: {}\nbudget: {{ spp: {} }}\n",
                     sampler, spp);
}

/// All random numbers that can be aligned, with one region per surface.
constexpr const char* kEverything =
    "{ type: aligned, purposes: [light_position, bsdf_direction, lens], "
    "estimation: { grid: { cells: 48 }, surfaces: {} } }";

/// Returns the variance of a pixel over seeds, averaged over all pixels of the penumbra.
double penumbra_variance(const std::string& sampler, int spp, int seeds) {
  const Renders renders = render_seeds(config_from(config(kPenumbra, sampler, spp)), seeds);
  const Image& first = renders.images.front();
  double sum = 0;
  for (int y = 0; y < first.height(); ++y) {
    for (int x = 0; x < first.width(); ++x) {
      std::vector<double> values;
      for (const Image& image : renders.images) values.push_back(image.rgb(x, y).g);
      sum += statistics::moments(values).variance;
    }
  }
  return sum / (first.width() * first.height());
}

}  // namespace

TEST_CASE("aligned: the image of independent numbers, whatever is aligned with") {
  constexpr int kRenders = 24, kSamples = 64;
  const auto independent =
      render_seeds(config_from(config(kBoard, "independent", kSamples)), kRenders);
  const auto aligned =
      render_seeds(config_from(config(kBoard, kEverything, kSamples)), kRenders, 1000);
  const statistics::AgreementOptions options{.effective_contributions = 400};
  const auto result = statistics::compare_images(aligned.side(), independent.side(), options);
  print_agreement("board, aligned", aligned.samples_per_pixel, result);
  check_agreement(result);
  check_bias_is_seen(aligned, independent.side(), options);
}

TEST_CASE("aligned: the same image with the light samples that were looked at") {
  // The numbers of samples and the blocks are so small that a large part of the samples comes from
  // the estimation.
  constexpr int kRenders = 64, kSamples = 4;
  const std::string sampler =
      "{{ type: aligned, samples: 64, estimation: {{ block: 4, grid: {{ "
      "cells: 12 }}, reuse: {} }} }}";
  const auto with = [&](bool reuse) {
    return config(kBoard, fmt::format(fmt::runtime(sampler), reuse), kSamples);
  };
  const auto independent =
      render_seeds(config_from(config(kBoard, "independent", 8 * kSamples)), kRenders);
  const auto reused = render_seeds(config_from(with(true)), kRenders, 1000);
  const statistics::AgreementOptions options{.effective_contributions = 400};
  const auto result = statistics::compare_images(reused.side(), independent.side(), options);
  print_agreement("board, aligned, looks count", reused.samples_per_pixel, result);
  check_agreement(result);
  check_bias_is_seen(reused, independent.side(), options);
  // The reused samples count in some pixels.
  const Image plain = render(with(false), 2).image, image = render(with(true), 2).image;
  int changed = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) changed += plain.rgb(x, y) != image.rgb(x, y);
  }
  CHECK(changed > 300);
  CHECK(changed < 1000);
}

TEST_CASE("aligned: the same bits for any number of threads, and not those of the base") {
  const auto pixels = [](const std::string& sampler, int threads) {
    return render(config(kBoard, sampler, 64), threads).image.values();
  };
  const std::vector<float> one = pixels(kEverything, 1);
  CHECK_FALSE(one == pixels("pmj02bn", 1));
  for (const int threads : {2, 3, 7}) {
    CAPTURE(threads);
    const bool same = pixels(kEverything, threads) == one;
    CHECK(same);
  }
}

TEST_CASE("aligned: edges have less variance than with points along the axes alone") {
  constexpr int kSamples = 256, kSeeds = 10;
  const double aligned = penumbra_variance("aligned", kSamples, kSeeds);
  const double plain = penumbra_variance("pmj02bn", kSamples, kSeeds);
  MESSAGE("variance " << plain << " and aligned " << aligned);
  CHECK(aligned < plain);
}

}  // namespace pharos::testing
