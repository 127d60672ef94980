// Guided and unguided renders of a scene show the same image, by the protocol of
// statistics/image_agreement.h. The scenes are variants of hard ones, with features large enough
// for unguided renders to converge. Prints one line a comparison.

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

/// A way to guide, as settings of the integrator's `guiding`.
struct Method {
  std::string name;
  std::vector<std::string> settings;
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

/// A pairwise covering array of unguided fractions, extents of splats and uses of training images,
/// and fractions that are learned.
std::vector<Method> methods() {
  return {focal(0.1f, "line", "discard"),
          focal(0.5f, "roughness_gated", "discard"),
          focal(0.9f, "line", "combine"),
          focal(0.1f, "roughness_gated", "combine"),
          focal(0.5f, "line", "combine"),
          focal(0.9f, "roughness_gated", "discard"),
          focal_learned()};
}

LoadedConfig load(const std::filesystem::path& config, const std::vector<std::string>& guiding,
                  std::vector<std::string> overrides = {}) {
  for (const std::string& setting : guiding) {
    overrides.push_back("integrator.guiding." + setting);
  }
  return load_render_config(config, overrides, registry());
}

/// Larger regions than needed for a t-test: unguided renders are so noisy here that a bias of 10 %
/// could not be seen in smaller ones.
constexpr statistics::AgreementOptions kOptions{.effective_contributions = 500};

/// Compares `methods` with unguided renders of the same number of samples.
void compare(const std::filesystem::path& config, std::span<const Method> methods) {
  const std::string scene = config.stem().string();
  const Renders unguided = render_seeds(load(config, {}), kRenders);
  const auto reference = unguided.side();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Renders guided =
        render_seeds(load(config, methods[i].settings), kRenders, 1000 * (i + 1));
    const auto result = statistics::compare_images(guided.side(), reference, kOptions);
    CAPTURE(scene);
    CAPTURE(methods[i].name);
    print_agreement(scene + ", " + methods[i].name, guided.samples_per_pixel, result);
    check_agreement(result);
    check_bias_is_seen(guided, reference, kOptions);
  }
}

/// Compares all methods on a proof variant.
void compare_proof(const std::string& scene) {
  compare(std::filesystem::path(PHAROS_PROOF_CONFIGS) / (scene + ".yaml"), methods());
}

/// Compares two shares of unguided samples where unguided renders alone would never converge.
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
  compare(std::filesystem::path(PHAROS_PROOF_CONFIGS) / "camera-obscura.yaml",
          std::array{methods().front()});
}

TEST_CASE("unbiased: every proof variant has a case below") {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(PHAROS_PROOF_CONFIGS)) {
    if (entry.path().extension() == ".yaml") found.push_back(entry.path().stem().string());
  }
  std::sort(found.begin(), found.end());
  CHECK(found == std::vector<std::string>{"camera-obscura", "dining-room", "disco-ball", "hall",
                                          "living-room"});
}

TEST_CASE("long: unbiased in the proof variant camera-obscura") {
  compare_proof("camera-obscura");
}
TEST_CASE("long: unbiased in the proof variant dining-room") {
  compare_proof("dining-room");
}
TEST_CASE("long: unbiased in the proof variant disco-ball") {
  compare_proof("disco-ball");
}
TEST_CASE("long: unbiased in the proof variant hall") {
  compare_proof("hall");
}
TEST_CASE("long: unbiased in the proof variant living-room") {
  compare_proof("living-room");
}

// (Not the smallest pinhole: with so few samples most renders have yet to find it.)
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
