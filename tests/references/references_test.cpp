// Whole images compared with images of an independent renderer, by the protocol of
// statistics/image_agreement.h. Every region of every image must agree, in a test that would detect
// a bias of 2 % of the image or 10 % of a region. An image that is 3 % too bright must be rejected.
// Prints one line per scene.

#include <filesystem>
#include <optional>

#include <doctest/doctest.h>

#include "agreement.h"

namespace pharos::testing {
namespace {

constexpr int kRenders = 32;

/// With fewer regions, a comparison says little about the distribution of light in the image.
constexpr std::size_t kFewestRegions = 50;

/// The references sum up to 16,384 samples per pixel in single precision. If all samples of a pixel
/// are equal, as in a constant background, each addition is rounded in the same way. For example, a
/// sky of 0.2 has the value 0.199983 in the references, and a sky of 0.3 has the value 0.300025.
/// These are relative errors of 1e-4 that are not noise.
constexpr double kReferenceRounding = 1e-4;

Renders render_scene(const std::string& name, const std::vector<std::string>& overrides) {
  const auto path = std::filesystem::path(PHAROS_REFERENCE_SCENES) / (name + ".yaml");
  return render_seeds(load_render_config(path, overrides, registry()), kRenders);
}

/// Returns the reference of a scene. Prints a message and returns nothing if there is no reference.
std::optional<statistics::ImageSide> reference_of(const std::string& name) {
  const auto file = std::filesystem::path(PHAROS_REFERENCES) / (name + "-halves.exr");
  if (std::filesystem::exists(file)) return statistics::ImageSide::of_halves(read_image(file));
  MESSAGE("no reference image of ", name, " here: skipped");
  return std::nullopt;
}

/// Compares the renders of a scene with its reference. The test must be able to detect a bias of
/// `region_bias` in each region, relative to its mean.
void compare(const std::string& name, const std::vector<std::string>& overrides = {},
             double region_bias = statistics::AgreementOptions{}.region_bias) {
  const auto reference = reference_of(name);
  if (!reference) return;
  const statistics::ImageSide& theirs = *reference;
  const Renders renders = render_scene(name, overrides);
  const statistics::AgreementOptions options{.region_bias = region_bias,
                                             .rounding = kReferenceRounding};
  const auto result = statistics::compare_images(renders.side(), theirs, options);
  print_agreement(name, renders.samples_per_pixel, result);
  check_agreement(result);
  CHECK(result.regions.size() >= kFewestRegions);
  const Ratio ratio = ratio_of(result.whole_image.a, result.whole_image.b);
  CHECK(std::abs(ratio.value - 1) + ratio.half_width <= 0.005);
  check_bias_is_seen(renders, theirs, options);
}

}  // namespace

TEST_CASE("reference: cornell-box") {
  compare("cornell-box");
}

TEST_CASE("reference: rough-conductors") {
  compare("rough-conductors");
}

TEST_CASE("reference: dielectrics") {
  compare("dielectrics");
}

TEST_CASE("reference: difftrans") {
  compare("difftrans");
}

TEST_CASE("reference: point-spot-directional") {
  compare("point-spot-directional");
}

TEST_CASE("reference: thin-lens") {
  // Each of two blocks contains three lit pixels, with 1e-4 of the image's light. There, the error
  // estimate from the two halves of the reference has less than five degrees of freedom. Hence no
  // number of samples here makes a bias of 10 % detectable. This number makes 12.8 % detectable.
  compare("thin-lens", {}, 0.15);
}

TEST_CASE("reference: environment-map") {
  compare("environment-map", {"scene.emitters.0.file=" PHAROS_REFERENCES "/environment.exr"});
}

// In this reference image, the MIS weight of a step that hits the lamp treats the last boundary of
// fog as the start of the step. This boundary is closer to the lamp, so that the image is too
// bright. If the same fault is planted, the images agree. Without the fault, the image of Pharos is
// 1.5 % darker.
TEST_CASE("reference: fog, with the fault that it has") {
  const std::string settings = "max_depth: 16, mis: power";
  const auto theirs = reference_of("fog");
  if (!theirs) return;
  compare("fog",
          {"integrator={ type: faulty_path, fault: boundaries_count_as_origins, settings: { " +
           settings + " } }"});
  const Renders ours = render_scene("fog", {"integrator={ type: path, " + settings + " }"});
  const auto result = statistics::compare_images(ours.side(), *theirs, {});
  const Ratio ratio = ratio_of(result.whole_image.a, result.whole_image.b);
  MESSAGE("without the fault: ", ratio.value, " +- ", ratio.half_width);
  CHECK(ratio.value + ratio.half_width < 0.99);
}

}  // namespace pharos::testing
