// The sampler `aligned` in renders: numbers that are aligned with what it finds show the image of
// independent numbers, with the same bits for any number of threads, and with less variance where
// there are edges.

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

/// Two square lights, before one of them a slanted board.
constexpr const char* kScene = R"(
scene:
  shapes:
    - { type: quad, to_world: [ { scale: [4, 4, 1] }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ], material: { type: diffuse, reflectance: 0.6, warp: octahedral } }
    - { type: quad, to_world: [ { scale: [2, 0.5, 1] }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { rotate: { axis: [0, 1, 0], degrees: 35 } }, { translate: [0.3, 1, 0.6] } ], material: { type: two_sided, bsdf: { type: diffuse, reflectance: 0.2 } } }
    - { type: quad, to_world: [ { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 3, 0] } ], emitter: { type: area, radiance: 8 } }
    - { type: quad, to_world: [ { scale: 0.3 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [2, 2.5, 1] } ], emitter: { type: area, radiance: 10 } }
  sensor: { to_world: { look_at: { origin: [0, 2, -5], target: [0, 0, 0], up: [0, 1, 0] } }, fov: 40, SENSOR }
film: { width: 32, height: 32, filter: box }
)";

/// What is rendered of it.
struct View {
  const char* sensor;
  int max_depth;
};
/// All that can be aligned matters.
constexpr View kWideLens{"type: thin_lens, aperture_radius: 0.1, focus_distance: 5", 3};
/// Only the lights do.
constexpr View kDirectLight{"type: perspective", 2};

std::string config(const View& view, const std::string& sampler, int spp) {
  std::string scene = kScene;
  const std::string place = "SENSOR";
  scene.replace(scene.find(place), place.size(), view.sensor);
  return scene + fmt::format(
                     "integrator: {{ type: path, max_depth: {}, light_selection: all }}\n"
                     "sampler: {}\nbudget: {{ spp: {} }}\n",
                     view.max_depth, sampler, spp);
}

/// All that can be aligned, in regions of a surface each.
constexpr const char* kEverything =
    "{ type: aligned, purposes: [light_position, bsdf_direction, lens], "
    "estimation: { grid: { cells: 48 }, surfaces: {} } }";

/// The variance of each pixel's direct light over seeds, mean of all pixels.
double mean_variance(const std::string& sampler, int spp, int seeds) {
  const Renders renders = render_seeds(config_from(config(kDirectLight, sampler, spp)), seeds);
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
      render_seeds(config_from(config(kWideLens, "independent", kSamples)), kRenders);
  const auto aligned =
      render_seeds(config_from(config(kWideLens, kEverything, kSamples)), kRenders, 1000);
  const statistics::AgreementOptions options{.effective_contributions = 400};
  const auto result = statistics::compare_images(aligned.side(), independent.side(), options);
  print_agreement("board, aligned", aligned.samples_per_pixel, result);
  check_agreement(result);
  check_bias_is_seen(aligned, independent.side(), options);
}

TEST_CASE("aligned: the same bits for any number of threads, and not those of the base") {
  const auto pixels = [](const std::string& sampler, int threads) {
    return render(config(kWideLens, sampler, 64), threads).image.values();
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
  const double aligned = mean_variance("aligned", kSamples, kSeeds);
  const double plain = mean_variance("pmj02bn", kSamples, kSeeds);
  MESSAGE("variance " << plain << " and aligned " << aligned);
  CHECK(aligned < plain);
}

}  // namespace pharos::testing
