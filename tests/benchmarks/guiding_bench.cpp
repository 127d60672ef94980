// Costs of guiding, for every registered pair of learner and guider: the time of a guide's answers
// on one thread, and the rays per second of a guided render relative to an unguided one, on two
// threads. Both use the model that is learned in 15 training iterations with 4 samples per pixel
// each.

#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/guided.h>
#include <pharos/rendering/render_job.h>

#include "bench.h"
#include "bench_scenes.h"
#include "guide_costs.h"
#include "guide_pairs.h"
#include "render_rate.h"

namespace pharos::bench {
namespace {

using testing::GuidePair;

constexpr std::size_t kVertices = 50'000;  // two densities are measured at each vertex
constexpr int kThreads = 2;
constexpr std::uint32_t kSamples = 32;  ///< samples per pixel of timed renders
constexpr const char* kGrowthScene = "camera-obscura";

std::string guided_config(const GuidePair& pair, const std::string& scene) {
  return fmt::format(R"({}
film: {{ width: 96, height: 64, filter: box }}
budget: {{ spp: 64 }}
sampler: independent
integrator:
  type: path
  max_depth: 10
  roulette: off
  guiding: {{ learner: {}, guider: {}, training: {{ iterations: 15, share: 0.95 }} }}
)",
                     scene, pair.learner, pair.guider);
}

/// A pair that has been trained on a scene. Throws RunError if it has learned nothing.
class Trained {
 public:
  Trained(const GuidePair& pair, const std::string& scene, const Registry& registry)
      : loaded_(build_render_config(parse_yaml(guided_config(pair, scene), "benchmark"), registry)),
        job_(loaded_.config),
        result_(job_.run()),
        frame_(conformance::frame_of(guider(), model())) {}

  const RenderConfig& config() const { return loaded_.config; }
  const Scene& scene() const { return job_.scene(); }
  const GuidingFrame& frame() const { return frame_; }
  const RenderResult& result() const { return result_; }
  BoundGuider bound_guider() const { return {guider(), model()}; }

 private:
  const Guider& guider() const {
    return *loaded_.config.integrator->guiding()->resolved_methods().front().guider;
  }

  const std::shared_ptr<const GuidingModel>& model() const {
    if (result_.model == nullptr) throw RunError("nothing was learned");
    return result_.model;
  }

  LoadedConfig loaded_;
  RenderJob job_;
  RenderResult result_;
  GuidingFrame frame_;
};

std::vector<Measurement> measure_answers(const GuidePair& pair, const Trained& trained,
                                         int repeats) {
  const auto queries = guide_queries(trained.scene(), trained.frame(), kVertices);
  const BoundGuider guider = trained.bound_guider();
  Measurement query{pair.name + ".query_ns", "ns", {}}, sample{pair.name + ".sample_ns", "ns", {}},
      pdf{pair.name + ".pdf_ns", "ns", {}}, allocations{pair.name + ".allocations", "1", {}};
  for (int i = 0; i < repeats; ++i) {
    const GuideCosts costs = measure_costs(guider, queries);
    query.runs.push_back(costs.query_ns);
    sample.runs.push_back(costs.sample_ns);
    pdf.runs.push_back(costs.pdf_ns);
    allocations.runs.push_back(static_cast<double>(costs.allocations));
  }
  return {pdf, sample, query, allocations};
}

/// `ending` is added to the names of the figures.
std::vector<Measurement> measure_render(const GuidePair& pair, const std::string& ending,
                                        const Trained& trained, int repeats) {
  const auto named = [&](const char* what) { return pair.name + "." + what + ending; };
  const RenderTimes& times = trained.result().times;
  const Measurement share{
      named("update_share"), "1", {times.update / (times.training + times.update)}};
  const Measurement bytes{
      named("model_bytes"), "B", {static_cast<double>(trained.result().model_bytes)}};
  const RenderRate rate(trained.config(), trained.scene(), kSamples);
  const GuidedSpeed speed = guided_speed(rate, trained.frame(), repeats);
  return {{named("added_ns"), "ns", speed.added_ns},
          {named("rays_ratio"), "1", speed.rays_ratio},
          share,
          bytes};
}

std::vector<Measurement> measure_pair(const GuidePair& pair, const SphereField& field,
                                      const Registry& registry, int repeats) {
  std::vector<Measurement> all;
  const auto add = [&](const std::vector<Measurement>& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  const std::vector<std::pair<std::string, std::string>> scenes{
      {"camera-obscura", scene_entry("camera-obscura")},
      {"cornell-box", scene_entry("cornell-box")},
      {"spheres-300k", field.entry()}};
  for (const auto& [name, entry] : scenes) {
    const Trained trained(pair, entry, registry);
    if (all.empty()) add(measure_answers(pair, trained, repeats));
    add(measure_render(pair, "." + name, trained, repeats));
  }
  return all;
}

/// Returns nothing, and says why, for a pair that cannot be measured.
std::vector<Measurement> measure_or_leave_out(const GuidePair& pair, const Registry& registry,
                                              int repeats) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  static const SphereField field;
  try {
    return arena.execute([&] { return measure_pair(pair, field, registry, repeats); });
  } catch (const Error& e) {
    fmt::print(stderr, "{} is left out: {}\n", pair.name, e.what());
    return {};
  }
}

/// Measures how the cost of focal guiding grows as its octrees become finer (Rath et al. 2023, fig.
/// 7).
std::vector<Measurement> measure_growth(const Registry& registry, int repeats) {
  std::vector<Measurement> all;
  for (const char* gamma : {"1e-1", "1e-2", "1e-3", "1e-4", "1e-5"}) {
    const GuidePair pair{.name = fmt::format("growth.focal-gamma.{}", gamma),
                         .learner = fmt::format("{{ type: focal, split_threshold: {} }}", gamma),
                         .guider = "focal"};
    const Trained trained(pair, scene_entry(kGrowthScene), registry);
    for (const auto& some :
         {measure_answers(pair, trained, repeats), measure_render(pair, "", trained, repeats)}) {
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  return all;
}

}  // namespace

std::vector<Measurement> bench_guiding_growth(int repeats) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  const Registry registry = load_default_modules();
  constexpr int kMostRuns = 3;
  return arena.execute([&] { return measure_growth(registry, std::min(repeats, kMostRuns)); });
}

std::vector<Group> guiding_groups(const std::shared_ptr<const Registry>& registry) {
  std::vector<Group> groups;
  for (const GuidePair& pair : testing::guide_pairs(*registry)) {
    groups.push_back({"guiding." + pair.name, [registry, pair](int repeats) {
                        return measure_or_leave_out(pair, *registry, repeats);
                      }});
  }
  return groups;
}

}  // namespace pharos::bench
