// Budgets, schedules, early ends and replay.

#include <atomic>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"

namespace pharos::testing {
namespace {

std::string cornell(const std::string& rest) {
  return fmt::format(
      "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 48, height: 40, filter: box }}\n"
      "sampler: independent\n{}",
      PHAROS_SCENES, rest);
}

TEST_CASE("a sample budget is kept exactly") {
  const RenderResult result = render(cornell("budget: { spp: 37 }\n"));
  CHECK(result.samples_per_pixel == doctest::Approx(37));
  CHECK(result.counters.paths == 37u * 48 * 40);
  CHECK(result.counters.invalid_paths == 0);
  const Image& image = result.image;
  const int samples = image.channel_index("samples.N");
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) REQUIRE(image.pixel(x, y)[samples] == 37);
  }
}

TEST_CASE("a time budget is kept roughly") {
  const RenderResult result = render(cornell("budget: { seconds: 0.5 }\n"));
  CHECK(result.times.rendering > 0.45);
  CHECK(result.times.rendering < 1.5);
  CHECK(result.samples_per_pixel >= 1);
}

TEST_CASE("training counts within the budget") {
  const RenderResult result =
      render(cornell("budget: { spp: 64 }\nintegrator: { type: path, guiding: { learner: "
                     "stub_direction, guider: stub_direction, training: { iterations: 4 } } }\n"));
  CHECK(result.counters.paths == 64u * 48 * 40);
  CHECK(result.model != nullptr);
  CHECK(result.model_bytes > 0);
  CHECK(result.image.pixel(0, 0)[result.image.channel_index("samples.N")] == 32);
}

TEST_CASE("the variance layer predicts the spread over seeds") {
  const int runs = 48;
  double predicted = 0, spread = 0;
  std::vector<Image> images;
  for (int seed = 1; seed <= runs; ++seed) {
    images.push_back(render(cornell(fmt::format("budget: {{ spp: 32 }}\nseed: {}\n", seed))).image);
  }
  const int channel = images[0].channel_index("variance.R");
  for (int y = 20; y < 24; ++y) {
    for (int x = 0; x < 48; ++x) {
      std::vector<double> values;
      for (const Image& image : images) {
        values.push_back(image.pixel(x, y)[0]);
        predicted += image.pixel(x, y)[channel] / runs;
      }
      const Estimate e = estimate(values);
      spread += e.standard_error * e.standard_error * runs;
    }
  }
  CHECK(predicted / spread == doctest::Approx(1).epsilon(0.2));
}

TEST_CASE("a stopped render keeps what it has") {
  const LoadedConfig loaded = config_from(cornell("budget: { spp: 100000 }\n"));
  std::atomic<bool> stop{false};
  RenderControl control;
  control.stop = &stop;
  control.on_progress = [&](const Progress& p) { stop = p.samples_per_pixel > 3; };
  const RenderResult result = RenderJob(loaded.config).run(control);
  CHECK(result.stopped);
  CHECK(result.samples_per_pixel > 0);
  CHECK(result.samples_per_pixel < 100000);
  CHECK(image_mean(result.image) > 0.05);
}

TEST_CASE("replay runs the very path") {
  // One sample a pixel and a box filter: the pixel is the path.
  const std::string config = cornell("budget: { spp: 1 }\n");
  const RenderResult result = render(config);
  const LoadedConfig loaded = config_from(config);
  RenderJob job(loaded.config);
  for (const auto& [x, y] : {std::pair{3, 7}, {20, 20}, {40, 33}}) {
    const PathTrace trace = job.replay(x, y, 0, 0);
    CHECK(trace.radiance == result.image.rgb(x, y));
    CHECK(trace.text.find("surface") != std::string::npos);
  }
}

TEST_CASE("replay knows what guides later iterations") {
  const std::string config = cornell(
      "budget: { spp: 2 }\nintegrator: { type: path, guiding: { learner: stub_direction, "
      "guider: stub_direction, training: { iterations: 1 } } }\n");
  const RenderResult result = render(config);
  const LoadedConfig loaded = config_from(config);
  RenderJob job(loaded.config);
  CHECK(job.replay(20, 20, 0, 1).radiance == result.image.rgb(20, 20));
}

}  // namespace
}  // namespace pharos::testing
