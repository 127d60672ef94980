// Budgets, schedules, interruption and replay.

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <memory>
#include <sstream>
#include <thread>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"

namespace pharos::testing {
namespace {

/// Returns whether two values have the same bits. This also works for infinities in the variance
/// layer.
bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

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

/// Returns the seconds that a render charges to its budget.
double charged(const RenderTimes& times) {
  return times.training + times.update + times.rendering;
}

RenderResult render_watched(const std::string& yaml,
                            std::function<void(const RenderSnapshot&)> on_pass) {
  const LoadedConfig loaded = config_from(yaml);
  return RenderJob(loaded.config).run({.on_progress = {}, .on_pass = std::move(on_pass)});
}

TEST_CASE("passes of a sample budget double what is done, up to an eighth of the budget") {
  std::vector<double> sums, fractions;
  render_watched(cornell("budget: { spp: 128 }\n"), [&](const RenderSnapshot& snapshot) {
    sums.push_back(snapshot.progress.samples_per_pixel);
    fractions.push_back(snapshot.progress.fraction * 128);
  });
  CHECK(sums == std::vector<double>{1, 2, 4, 8, 16, 32, 48, 64, 80, 96, 112, 128});
  CHECK(fractions == sums);
}

TEST_CASE("watching changes no bit, and the last image seen is that of the render") {
  const std::string guided =
      "integrator: { type: path, guiding: { learner: stub_direction, guider: stub_direction, "
      "training: { iterations: 3, images: combine } } }\n";
  for (const std::string& rest : {std::string(), guided}) {
    const std::string yaml = cornell(rest + "budget: { spp: 32 }\n");
    std::vector<Image> seen;
    const RenderResult watched = render_watched(
        yaml, [&](const RenderSnapshot& snapshot) { seen.push_back(snapshot.image()); });
    REQUIRE(seen.size() > 4);
    CHECK(std::ranges::equal(seen.back().values(), watched.image.values(), same_bits));
    CHECK(std::ranges::equal(watched.image.values(), render(yaml).image.values(), same_bits));
    CHECK_FALSE(std::ranges::equal(seen.front().values(), watched.image.values(), same_bits));
  }
}

TEST_CASE("a time budget is kept roughly, alone and with training") {
  const std::string guided =
      "integrator: { type: path, guiding: { learner: stub_direction, guider: stub_direction, "
      "training: { iterations: 3 } } }\n";
  for (const std::string& rest : {std::string(), guided}) {
    double last = 0;
    const RenderResult result =
        render_watched(cornell(rest + "budget: { seconds: 2 }\n"),
                       [&](const RenderSnapshot& snapshot) { last = snapshot.progress.seconds; });
    // A pass takes less than 1/64 of its iteration. A busy machine may extend the last pass.
    CHECK(charged(result.times) > 1.8);
    CHECK(charged(result.times) < 2.4);
    CHECK(std::abs(charged(result.times) - last) < 0.1);
    CHECK(result.samples_per_pixel >= 1);
  }
}

TEST_CASE("what watching takes is not charged to a time budget") {
  // The pauses add up to more than the whole budget.
  int passes = 0;
  double last = 0;
  const RenderResult result =
      render_watched(cornell("budget: { seconds: 0.5 }\n"), [&](const RenderSnapshot& snapshot) {
        last = snapshot.progress.seconds;
        if (++passes <= 5) std::this_thread::sleep_for(std::chrono::milliseconds(200));
      });
  CHECK(passes > 5);
  CHECK(charged(result.times) < 0.9);
  CHECK(last < 0.9);
}

TEST_CASE("guides of little gain cost little, and the image goes on without them") {
  double training = 0;
  const RenderResult result = render_watched(
      cornell(
          "integrator: { type: path, guiding: { learner: stub_direction, guider: stub_direction, "
          "training: { schedule: geometric, least_gain: 100, trial: 0.03 } } }\n"
          "budget: { spp: 64 }\n"),
      [&](const RenderSnapshot& snapshot) {
        if (snapshot.progress.training) training = snapshot.progress.samples_per_pixel;
      });
  // One sample without a guide, one with a guide, and one more to compare with. The trial allows no
  // longer iterations. Training then ends.
  CHECK(training == 3);
  CHECK(result.samples_per_pixel == 64);
  REQUIRE(result.gain.has_value());
  CHECK(result.gain->is_off);
}

TEST_CASE("training counts within the budget") {
  const RenderResult result =
      render(cornell("budget: { spp: 64 }\nintegrator: { type: path, guiding: { learner: "
                     "stub_direction, guider: stub_direction, training: { iterations: 4, images: "
                     "discard } } }\n"));
  CHECK(result.counters.paths == 64u * 48 * 40);
  CHECK(result.model != nullptr);
  CHECK(result.model_bytes > 0);
  CHECK(result.image.pixel(0, 0)[result.image.channel_index("samples.N")] == 32);
}

/// A sampler that waits before it prepares another one.
class SlowToPrepare final : public Sampler {
 public:
  explicit SlowToPrepare(Ref<Sampler> other) : other_(std::move(other)) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return other_->prepare(grid, plan, probe);
  }

 private:
  Ref<Sampler> other_;
};

TEST_CASE("guides learn from as many samples of an iteration as are recorded") {
  const auto trained = [](int spp, const std::string& more) {
    return render(cornell(
        fmt::format("budget: {{ spp: {} }}\nintegrator:\n  type: path\n  guiding:\n"
                    "    learner: parallax_aware_mixtures\n    guider: parallax_aware_mixtures\n"
                    "    training: {{ iterations: 1, region_samples: 0, {} }}\n",
                    spp, more)));
  };
  const auto model_of = [](const RenderResult& result) {
    std::ostringstream model;
    save(model, *result.learned->models.at(0).model);
    return model.str();
  };
  // The order of samples decides the bits of a model. Passes of one sample have the same in both.
  const RenderResult few = trained(4, "images: combine");
  const RenderResult part = trained(60, "images: combine, recorded_samples: 2");
  CHECK(part.samples_per_pixel == doctest::Approx(60));
  CHECK(part.counters.paths == 60u * 48 * 40);
  bool same = model_of(part) == model_of(few);
  CHECK(same);
  same = model_of(part) == model_of(trained(60, "images: combine"));
  CHECK_FALSE(same);
}

TEST_CASE("what the sampler takes to prepare itself counts within a time budget") {
  LoadedConfig loaded = config_from(cornell("budget: { seconds: 0.1 }\n"));
  loaded.config.sampler = std::make_shared<SlowToPrepare>(loaded.config.sampler);
  double told = 0;
  const RenderResult late =
      RenderJob(loaded.config).run({.on_progress = {}, .on_pass = [&](const RenderSnapshot& s) {
                                      told = s.progress.seconds;
                                    }});
  CHECK(told >= 0.2);
  CHECK(late.times.sampler >= 0.2);
  CHECK(late.times.budgeted() >= 0.2);
  // No time is left, but every pixel still gets a sample.
  CHECK(late.samples_per_pixel == 1);
}

TEST_CASE("without jitter paths pass through the middles of pixels") {
  RenderJob job(config_from(cornell("budget: { spp: 2 }\n")).config);
  std::string still = cornell("budget: { spp: 2 }\n");
  still.replace(still.find("filter: box"), 11, "filter: box, jitter: false");
  RenderJob still_job(config_from(still).config);
  const std::string middle = "film (31.5000, 22.5000)";
  CHECK(still_job.replay(31, 22, 1, 0).text.starts_with(middle));
  CHECK_FALSE(job.replay(31, 22, 1, 0).text.starts_with(middle));
  const auto albedo = [](const std::string& film, int seed) {
    const std::string yaml = fmt::format(
        "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 24, height: 20, filter: box{} }}\n"
        "sampler: independent\nbudget: {{ spp: 3 }}\nseed: {}\n",
        PHAROS_SCENES, film, seed);
    const Image image = render(yaml).image;
    const int red = image.channel_index("albedo.R");
    std::vector<float> values;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) values.push_back(image.pixel(x, y)[red]);
    }
    return values;
  };
  CHECK(albedo(", jitter: false", 1) == albedo(", jitter: false", 2));
  CHECK(albedo("", 1) != albedo("", 2));
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

/// Checks that replayed paths of an iteration have the values of their pixels, and that the text
/// about them contains `part`. The iteration has one sample per pixel, and its image alone counts.
void check_replay(const std::string& config, std::uint32_t iteration, std::string_view part) {
  const RenderResult result = render(config);
  const LoadedConfig loaded = config_from(config);
  RenderJob job(loaded.config);
  for (const auto& [x, y] : {std::pair{3, 7}, {20, 20}, {40, 33}}) {
    const PathTrace trace = job.replay(x, y, 0, iteration);
    CHECK(trace.radiance == result.image.rgb(x, y));
    CHECK(trace.text.find(part) != std::string::npos);
  }
}

TEST_CASE("replay runs the very path") {
  // With one sample per pixel and a box filter, the value of the pixel is the value of the path.
  const std::string config = cornell("budget: { spp: 1 }\n");
  check_replay(config, 0, "surface");
}

TEST_CASE("replay knows what guides later iterations") {
  const std::string config = cornell(
      "budget: { spp: 2 }\nintegrator: { type: path, guiding: { learner: stub_direction, "
      "guider: stub_direction, training: { iterations: 1, images: discard } } }\n");
  check_replay(config, 1, "surface");
}

/// The means of the layers of an image that tell of its paths.
struct PathLayers {
  double first = 0, second = 0;  ///< factor at the vertices number 1 and 2 where there are such
  double cost = 0;
};

TEST_CASE("layers: the factors at the first vertices, and the number of steps") {
  const auto layers_of = [](const std::string& termination) {
    const RenderResult result = render(
        cornell(fmt::format("budget: {{ spp: 32 }}\nintegrator: {{ type: path, max_depth: 3, "
                            "next_event_estimation: false, termination: {} }}\n",
                            termination)));
    const Image& image = result.image;
    const auto mean_of = [&](const char* channel) {
      const int c = image.channel_index(channel);
      double sum = 0, count = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          sum += image.pixel(x, y)[c];
          count += image.pixel(x, y)[c] > 0 ? 1 : 0;
        }
      }
      CHECK(count > 0.5 * image.width() * image.height());
      return sum / count;
    };
    return PathLayers{mean_of("splitting.1"), mean_of("splitting.2"), mean_of("cost.N")};
  };
  const PathLayers whole = layers_of("none");
  CHECK(whole.first == doctest::Approx(1));
  CHECK(whole.second == doctest::Approx(1));
  const PathLayers split = layers_of("{ type: stub_factor, factor: 2.5 }");
  CHECK(split.first == doctest::Approx(2.5));
  CHECK(split.second == doctest::Approx(2.5));
  const PathLayers late = layers_of("{ type: stub_factor, factor: 1.5, first: 2 }");
  CHECK(late.first == doctest::Approx(1));
  CHECK(late.second == doctest::Approx(1.5));
  // At most one step from the lens, 2.5 from the first vertex, and 6.25 from the second.
  CHECK(whole.cost > 2);
  CHECK(whole.cost <= 3);
  CHECK(split.cost > 2 * whole.cost);
  CHECK(split.cost <= 9.75);
}

TEST_CASE("replay runs all branches of a path and names them") {
  const std::string config = cornell(
      "budget: { spp: 1 }\nintegrator: { type: path, termination: { type: stub_factor, factor: 2 } "
      "}\n");
  check_replay(config, 0, "branch 1 after 0");
}

TEST_CASE("replay knows the factors that later iterations have learned") {
  const std::string config = cornell(
      "budget: { spp: 2 }\nintegrator: { type: path, termination: { type: adjoint, window: 1 }, "
      "training: { iterations: 1, images: discard } }\n");
  check_replay(config, 1, "surface");
}

}  // namespace
}  // namespace pharos::testing
