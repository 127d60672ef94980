// The cost of the machinery of terminations: the speed of renders whose factors are all one,
// relative to the same render with the termination `none`, on two threads. All of them trace the
// same number of paths, of the same length.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/rendering/render_job.h>

#include "bench.h"
#include "bench_scenes.h"
#include "renders.h"

namespace pharos::bench {
namespace {

constexpr int kThreads = 2;

/// `settings` are further settings of the integrator.
LoadedConfig config_with(const std::string& scene, const std::string& settings) {
  return testing::config_from(fmt::format(R"({}
film: {{ width: 240, height: 160, filter: box }}
budget: {{ spp: 64 }}
sampler: independent
integrator: {{ type: path, max_depth: 10, {} }}
)",
                                          scene_entry(scene), settings));
}

/// A rule is asked at every vertex.
constexpr const char* kAsked = "termination: { type: stub_factor, factor: 1 }";
/// The factors are learned, too. The roulette of the first iterations begins after the last vertex.
constexpr const char* kLearned =
    "termination: { type: adjoint, least: 1, most: 1, first: { depth: 100 } }, "
    "training: { schedule: uniform, iterations: 15, images: combine }";

/// A render that can be repeated.
class TimedRender {
 public:
  TimedRender(const std::string& scene, const std::string& settings)
      : loaded_(config_with(scene, settings)), job_(loaded_.config) {}

  /// Returns the seconds of a render, training included.
  double seconds() { return job_.run().times.budgeted(); }

 private:
  LoadedConfig loaded_;
  RenderJob job_;
};

std::vector<Measurement> measure_scene(const std::string& scene, int repeats) {
  TimedRender none(scene, "termination: none"), asked(scene, kAsked), learned(scene, kLearned);
  const auto named = [&](const char* what) { return "terminations." + scene + "." + what; };
  Measurement asked_rate{named("asked_rate"), "1", {}};
  Measurement learned_rate{named("learned_rate"), "1", {}};
  none.seconds(), asked.seconds(), learned.seconds();  // warm-up
  for (int i = 0; i < repeats; ++i) {
    const double without = none.seconds();
    asked_rate.runs.push_back(without / asked.seconds());
    learned_rate.runs.push_back(without / learned.seconds());
  }
  return {asked_rate, learned_rate};
}

}  // namespace

std::vector<Measurement> bench_terminations(int repeats) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  std::vector<Measurement> all;
  for (const char* scene : {"cornell-box", "living-room", "fog-box"}) {
    const auto some = arena.execute([&] { return measure_scene(scene, repeats); });
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace pharos::bench
