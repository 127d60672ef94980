// Renders with any sampler have the same mean as renders with independent random numbers, by the
// protocol of statistics/image_agreement.h. Different seeds are independent observations, even if
// the random numbers of one image depend on each other. Prints one line per comparison.

#include "agreement.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"
#include "subjects.h"

namespace pharos::testing {
namespace {

constexpr int kRenders = 32;

/// A scene that needs only some thousand samples.
struct View {
  std::string name;
  std::string scene;
  int samples;  ///< per pixel
};

/// Diffuse interreflection.
View cornell_box() {
  return {"cornell-box", fmt::format("{}/cornell-box/scene.yaml", PHAROS_SCENES), 64};
}

/// Lamps of all sizes, and wide and narrow lobes.
View lamps() {
  return {"lamps", R"(
  shapes:
    - { type: quad, material: { type: diffuse, reflectance: 0.5 }, to_world: [ { scale: 6 }, { translate: [0, 0, -1] } ] }
    - { type: sphere, radius: 0.7, center: [-0.8, -0.6, -0.3], material: { type: rough_conductor, material: Cu, alpha: 0.3 } }
    - { type: sphere, radius: 0.7, center: [0.8, -0.6, -0.3], material: { type: rough_plastic, alpha: 0.4, reflectance: [0.2, 0.4, 0.6] } }
    - { type: sphere, radius: 0.6, center: [0, 0.7, -0.4], material: { type: plastic, reflectance: 0.4 } }
    - { type: sphere, radius: 0.2, center: [-2.2, 1.5, 2], emitter: { type: area, radiance: [50, 30, 10] } }
    - { type: sphere, radius: 0.6, center: [2.5, 1, 2.5], emitter: { type: area, radiance: 5 } }
  emitters: [ { type: constant, radiance: 0.2 }, { type: point, intensity: [2, 4, 8], position: [0, -2, 3] } ]
  sensor: { type: perspective, fov: 45, to_world: { look_at: { origin: [0, 0, 4], target: [0, 0, 0], up: [0, 1, 0] } } })",
          32};
}

/// A wide lens in front of a checkered floor under the sky.
View lens() {
  return {"lens", R"(
  shapes:
    - { type: quad, material: { type: diffuse, reflectance: { type: checkerboard, color0: 0.1, color1: 0.8, uv_scale: [20, 20] } }, to_world: [ { scale: 8 }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ] }
    - { type: sphere, radius: 0.5, center: [-0.8, 0.5, 1], material: { type: diffuse, reflectance: [0.7, 0.3, 0.2] } }
    - { type: sphere, radius: 0.5, center: [0.8, 0.5, -1], material: { type: rough_plastic, alpha: 0.3, reflectance: [0.2, 0.4, 0.6] } }
  emitters: [ { type: constant, radiance: [0.6, 0.8, 1] } ]
  sensor: { type: thin_lens, fov: 40, aperture_radius: 0.3, focus_distance: 4, to_world: { look_at: { origin: [0, 1.2, 5], target: [0, 0.4, 0], up: [0, 1, 0] } } })",
          16};
}

LoadedConfig config_of(const View& view, const std::string& sampler) {
  return config_from(fmt::format(
      "scene: {}\nfilm: {{ width: 48, height: 48, filter: box }}\n"
      "integrator: {{ type: path, max_depth: 4 }}\nbudget: {{ spp: {} }}\nsampler: {}\n",
      view.scene, view.samples, sampler));
}

/// Returns the options of one comparison in a run with `count` comparisons. The significance levels
/// add up to the level of one family. The regions are larger than a t-test needs, so that the test
/// has enough power at the strict level.
statistics::AgreementOptions options_for(std::size_t count) {
  statistics::AgreementOptions options{.effective_contributions = 400};
  options.family_level /= static_cast<double>(count);
  return options;
}

/// Compares samplers with independent random numbers. Each sampler uses other seeds.
void compare(const View& view, const std::vector<SamplerSubject>& samplers,
             const statistics::AgreementOptions& options) {
  const auto reference = render_seeds(config_of(view, "independent"), kRenders).side();
  std::uint64_t seed = 1000;
  for (const SamplerSubject& subject : samplers) {
    const Renders renders = render_seeds(config_of(view, subject.settings), kRenders, seed);
    seed += 1000;
    const auto result = statistics::compare_images(renders.side(), reference, options);
    CAPTURE(view.name);
    CAPTURE(subject.name);
    print_agreement(fmt::format("{}, {}", view.name, subject.name), renders.samples_per_pixel,
                    result);
    check_agreement(result);
    check_bias_is_seen(renders, reference, options);
  }
}

}  // namespace

TEST_CASE("samplers: the default one shows the image of independent numbers") {
  compare(lens(), {{"default", "default"}}, options_for(1));
}

TEST_CASE("long: every sampler shows the image of independent numbers") {
  const std::vector<SamplerSubject> samplers = sampler_subjects();
  const std::vector<View> views{cornell_box(), lamps(), lens()};
  const auto options = options_for(samplers.size() * views.size());
  for (const View& view : views) compare(view, samplers, options);
}

}  // namespace pharos::testing
