// The scenes and configs of the repository.

#include <filesystem>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/experiments/runner/plan.h>

#include "renders.h"

namespace pharos::testing {
namespace {

const std::filesystem::path kConfigs = PHAROS_CONFIGS;

RenderResult render_config(const std::filesystem::path& path,
                           const std::vector<std::string>& overrides) {
  return RenderJob(load_render_config(path, overrides, registry()).config).run();
}

/// Renders a small image. It must contain light with 4 samples per pixel or, in scenes where light
/// is hard to find (such as a pinhole), with 64.
void check_finds_light(const std::filesystem::path& path) {
  double found = 0;
  for (const int samples : {4, 64}) {
    const RenderResult result = render_config(
        path, {"film.width=48", "film.height=32", fmt::format("budget={{ spp: {} }}", samples)});
    CHECK(result.samples_per_pixel == samples);
    CHECK_FALSE(result.first_invalid.has_value());
    found = image_mean(result.image);
    if (found > 0) break;
  }
  CHECK(found > 0);
}

TEST_CASE("every config loads and renders something") {
  int configs = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kConfigs)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".yaml") continue;                 // a folder or points
    if (read_config(path).find("scene") == nullptr) continue;  // a base or an experiment
    CAPTURE(path.string());
    check_finds_light(path);
    ++configs;
  }
  CHECK(configs >= 18);
}

TEST_CASE("every experiment can be planned") {
  int experiments = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kConfigs / "experiments")) {
    CAPTURE(entry.path().string());
    const ExperimentConfig config = load_experiment(entry.path(), {}, registry());
    CHECK(plan_experiment(config, registry()).cells.size() ==
          config.scenes.size() * config.methods.size());
    ++experiments;
  }
  CHECK(experiments >= 3);
}

/// A ring with its normals up lights only the gap below the ceiling, which passes for a dim scene.
TEST_CASE("the ring of the mirror chamber shines down") {
  for (const char* config : {"mirror-chamber.yaml", "proof/mirror-chamber.yaml"}) {
    CAPTURE(config);
    const RenderJob job(load_render_config(kConfigs / config, {}, registry()).config);
    REQUIRE(job.scene().lights().size() == 1);
    for (int i = 0; i < 64; ++i) {
      const Vec2 u{(i % 8 + 0.5f) / 8, (i / 8 + 0.5f) / 8};
      CHECK(job.scene().lights()[0]->sample_emission(u, u).direction.y < 0);
    }
  }
}

TEST_CASE("furnace: nothing can be seen, anywhere in the image") {
  constexpr int kRuns = 16, kBlocks = 4;
  std::vector<double> blocks[kBlocks][kBlocks];
  for (int run = 1; run <= kRuns; ++run) {
    const Image image = render_config(kConfigs / "furnace.yaml",
                                      {"film={ width: 32, height: 32 }", "budget={ spp: 16 }",
                                       fmt::format("seed={}", run)})
                            .image;
    const int size = image.width() / kBlocks;
    for (int i = 0; i < square(kBlocks); ++i) {
      double sum = 0;
      for (int p = 0; p < square(size); ++p) {
        sum += mean(image.rgb(i % kBlocks * size + p % size, i / kBlocks * size + p / size));
      }
      blocks[i / kBlocks][i % kBlocks].push_back(sum / square(size));
    }
  }
  for (const auto& row : blocks) {
    for (const std::vector<double>& block : row) {
      const Estimate value = estimate(block);
      CHECK(value.standard_error < 0.003);  // a bias of 1.5 % is detectable
      CHECK(std::abs(value.mean - 1) < 5 * value.standard_error);
    }
  }
}

}  // namespace
}  // namespace pharos::testing
