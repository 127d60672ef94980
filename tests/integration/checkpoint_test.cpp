// A render that goes on from a state gives the same bits as one that never stopped.

#include <cstring>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/stopwatch.h>

#include "renders.h"

namespace pharos::testing {
namespace {

/// A small render of six tiles in `scene`.
std::string config_in(const char* scene, const std::string& rest, int spp = 16) {
  return fmt::format(
      "scene: {}/{}/scene.yaml\nfilm: {{ width: 24, height: 16, tile: 8, filter: gaussian }}\n"
      "budget: {{ spp: {} }}\n{}",
      PHAROS_SCENES, scene, spp, rest);
}

/// The states that a render hands out: one after every `interval` work units, and the last one.
struct States {
  std::vector<std::string> states;
  int finished = 0;  ///< number of states of the finished render
  std::string bits;  ///< of the result
};

States states_of(const std::string& config, int interval) {
  States found;
  int units = 0;
  RenderControl control;
  control.checkpoint.is_due = [&] { return ++units % interval == 0; };
  control.checkpoint.take = [&](std::string state, bool finished) {
    found.states.push_back(std::move(state));
    found.finished += finished ? 1 : 0;
  };
  found.bits = bits_of(RenderJob(config_from(config).config).run(control));
  return found;
}

std::string bits_after(const std::string& config, const std::string& state) {
  return bits_of(RenderJob(config_from(config).config).run({}, state));
}

/// Goes on from states in all parts of a render. The interval shares no divisor with the number of
/// tiles, so states lie within passes, too.
void check_goes_on(const std::string& config) {
  const States whole = states_of(config, 19);
  CHECK(whole.finished == 1);
  CHECK(whole.states.size() >= 3);
  const RenderResult undisturbed = render(config);
  CHECK(whole.bits == bits_of(undisturbed));
  for (std::size_t i = 0; i < whole.states.size(); ++i) {
    CAPTURE(i);
    const RenderResult result = RenderJob(config_from(config).config).run({}, whole.states[i]);
    const bool same = bits_of(result) == whole.bits;
    CHECK(same);
    CHECK(result.counters.paths == undisturbed.counters.paths);
    CHECK(result.counters.rays == undisturbed.counters.rays);
    CHECK(result.samples_per_pixel == undisturbed.samples_per_pixel);
  }
}

TEST_CASE("checkpoints: unguided, and light paths") {
  for (const char* integrator : {"path", "bidirectional", "light"}) {
    check_goes_on(config_in("cornell-box", fmt::format("integrator: {}\n", integrator)));
  }
}

TEST_CASE("checkpoints: what terminations learn, with and without guides") {
  for (const char* termination : {"adjoint", "efficiency"}) {
    check_goes_on(config_in("cornell-box",
                            fmt::format("integrator: {{ type: path, termination: {}, training: {{ "
                                        "iterations: 3 }} }}\n",
                                        termination)));
    check_goes_on(config_in(
        "cornell-box",
        fmt::format("integrator: {{ type: path, termination: {}, guiding: {{ learner: "
                    "stub_direction, guider: stub_direction, training: {{ iterations: 2 }} }} }}\n",
                    termination)));
  }
}

TEST_CASE("checkpoints: every preset") {
  for (const char* preset : {"adrrs",
                             "ears",
                             "focal",
                             "focal-robust",
                             "pairs",
                             "pavmm",
                             "pavmm-product",
                             "pavmm-robust",
                             "ppg-improved",
                             "ppg-paper",
                             "ppg-rare-light",
                             "ppg-robust",
                             "robust",
                             "robust-adrrs",
                             "robust-ears",
                             "spatial-gaussians",
                             "spatial-gaussians-robust",
                             "triplets",
                             "triplets-robust",
                             "varpg",
                             "vmm"}) {
    CAPTURE(preset);
    check_goes_on(config_in("cornell-box",
                            fmt::format("integrator: {{ type: path, guiding: {} }}\n", preset)));
  }
}

TEST_CASE("checkpoints: vertex triplets that learn from light paths in fog") {
  for (const char* light_paths : {"training", "always"}) {
    check_goes_on(config_in("fog-box", fmt::format(R"(
integrator:
  type: bidirectional
  light_paths: {}
  guiding: {{ learner: {{ type: vertex_triplets, light_paths: true }}, guider: vertex_triplets,
             training: {{ schedule: geometric }} }}
)",
                                                   light_paths)));
  }
}

TEST_CASE("checkpoints: images of training that are combined or thrown away") {
  for (const char* images : {"combine", "discard"}) {
    check_goes_on(config_in("cornell-box", fmt::format(R"(
integrator:
  type: path
  guiding: {{ learner: practical_path_guiding, guider: practical_path_guiding, mixing: learned,
             training: {{ schedule: geometric, images: {} }} }}
)",
                                                       images)));
  }
}

TEST_CASE("checkpoints: a stopped render hands out one state, and goes on from it") {
  const std::string config =
      config_in("cornell-box", "integrator: { type: path, guiding: pavmm }\n", 32);
  const std::string whole = bits_of(render(config));
  for (const int stop_after : {1, 7, 12, 40, 64, 95}) {
    CAPTURE(stop_after);
    std::atomic<bool> stop{false};
    int units = 0;
    std::vector<std::string> states;
    RenderControl control;
    control.stop = &stop;
    control.checkpoint.is_due = [&] {
      stop = ++units >= stop_after;
      return false;
    };
    control.checkpoint.take = [&](std::string state, bool finished) {
      states.push_back(std::move(state));
      CHECK_FALSE(finished);
    };
    CHECK(RenderJob(config_from(config).config).run(control).stopped);
    REQUIRE(states.size() == 1);
    CHECK(bits_after(config, states[0]) == whole);
  }
}

TEST_CASE("checkpoints: a finished image gets more samples") {
  const auto config = [](int spp) {
    return config_in("cornell-box", "integrator: { type: path, guiding: focal }\n", spp);
  };
  const States first = states_of(config(16), 1000);
  REQUIRE(first.states.size() == 1);
  const RenderResult more = RenderJob(config_from(config(64)).config).run({}, first.states[0]);
  CHECK(more.samples_per_pixel == 64);
  CHECK(image_mean(more.image) > 0);
  // The models learn no more, and the samples that were there are part of the image.
  const RenderResult same = RenderJob(config_from(config(16)).config).run({}, first.states[0]);
  CHECK(bits_of(same) == first.bits);
  const auto model_bits = [](const RenderResult& result) {
    return bits_of(result).substr(result.image.values().size() * sizeof(float));
  };
  CHECK(model_bits(more) == model_bits(same));
  CHECK(same.counters.paths > 0);
  CHECK(more.counters.paths > 3 * same.counters.paths);
}

TEST_CASE("checkpoints: the samples of a finished image are part of the longer one") {
  const auto config = [](int spp) { return config_in("cornell-box", "", spp); };
  const States first = states_of(config(16), 1000);
  REQUIRE(first.states.size() == 1);
  const Image more = RenderJob(config_from(config(64)).config).run({}, first.states[0]).image;
  const Image whole = render(config(64)).image;
  // The layer `variance` depends on how samples are divided into passes.
  for (int y = 0; y < whole.height(); ++y) {
    for (int x = 0; x < whole.width(); ++x) {
      const Rgb a = more.rgb(x, y), b = whole.rgb(x, y);
      for (int c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(1e-4));
    }
  }
}

TEST_CASE("checkpoints: the time that was used counts") {
  const auto config = [](double seconds) {
    return fmt::format(
        "scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 24, height: 16 }}\n"
        "budget: {{ seconds: {} }}\n",
        PHAROS_SCENES, seconds);
  };
  std::string state;
  std::atomic<bool> stop{false};
  RenderControl control;
  control.stop = &stop;
  control.on_progress = [&](const Progress& p) { stop = p.seconds > 0.5; };
  control.checkpoint.take = [&](std::string taken, bool) { state = std::move(taken); };
  RenderJob(config_from(config(1)).config).run(control);
  RenderJob job(config_from(config(1)).config);
  const Stopwatch watch;
  const RenderResult rest = job.run({}, state);
  CHECK(watch.seconds() < 0.95);  // half a second was left
  CHECK(rest.times.budgeted() > 0.9);
  CHECK(rest.times.budgeted() < 1.4);
}

TEST_CASE("checkpoints: a damaged state is refused") {
  const std::string config =
      config_in("cornell-box", "integrator: { type: path, guiding: pavmm }\n");
  const States whole = states_of(config, 31);
  for (const std::string& state : whole.states) {
    for (const std::size_t length : {std::size_t{1}, state.size() / 2, state.size() - 1}) {
      CHECK_THROWS_AS(bits_after(config, state.substr(0, length)), InputError);
    }
    CHECK_THROWS_AS(bits_after(config, state + "x"), InputError);
  }
  // The time that was used comes first, after the heading, which ends its line.
  const std::string& last = whole.states.back();
  for (const double seconds : {-1.0, 1e240}) {
    std::string odd = last;
    std::memcpy(odd.data() + odd.find('\n') + 1, &seconds, sizeof seconds);
    CHECK_THROWS_AS(bits_after(config, odd), InputError);
  }
}

}  // namespace
}  // namespace pharos::testing
