// Costs of vertex triplets: the time of one step of expectation-maximization, and the time of a
// guide's answers by the number of components, both on one thread. Renders on two threads
// give the share of learning in training, rays per second relative to an unguided render,
// and memory, in scenes for which the method was made.

#include <algorithm>
#include <chrono>
#include <memory>
#include <vertex_triplets/expectation_maximization.h>
#include <vertex_triplets/guider.h>
#include <vertex_triplets/model.h>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/guided.h>
#include <pharos/rendering/render_job.h>

#include "bench.h"
#include "bench_scenes.h"
#include "guide_costs.h"
#include "render_rate.h"

namespace pharos::bench {
namespace {

using namespace vertex_triplets;

constexpr std::size_t kVertices = 20'000;
constexpr int kThreads = 2;
constexpr int kMostRenders = 3;        ///< runs of whole renders, which take a second each
constexpr std::uint32_t kSamples = 8;  ///< samples per pixel of these renders

float between(float low, float high, RandomStream& random) {
  return low + (high - low) * random.next_1d();
}

/// Measures the milliseconds of an E step and an M step with 4096 points and 128 components in 9
/// dimensions. The points are ordered by cluster, as they are in learning.
Measurement em_step(int repeats) {
  constexpr int kPoints = 4096, kComponents = 128;
  RandomStream random(1);
  Mixture<9> mixture;
  Points<9> points;
  for (int k = 0; k < kComponents; ++k) {
    mixture.weights.push_back(1.0 / kComponents);
    statistics::Gaussian<9> gaussian;
    for (double& x : gaussian.mean) x = between(-1, 1, random);
    gaussian.covariance *= 0.04;
    for (int i = 0; i < kPoints / kComponents; ++i) {
      std::array<float, 9> x;
      for (int axis = 0; axis < 9; ++axis) {
        x[axis] = static_cast<float>(gaussian.mean[axis]) + between(-0.35f, 0.35f, random);
      }
      points.add(x, between(0.5f, 1.5f, random));
    }
    mixture.components.push_back(gaussian);
  }
  Measurement step{"triplets.em_step_ms", "ms", {}};
  constexpr int kSteps = 20;
  for (int i = 0; i < repeats; ++i) {
    Mixture<9> at = mixture;
    const auto start = std::chrono::steady_clock::now();
    for (int s = 0; s < kSteps; ++s) at = maximization(at, expectation(at, points), {});
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    step.runs.push_back(elapsed.count() / kSteps);
  }
  return step;
}

/// Returns a model with one cell in which all components contribute to every step through the
/// scene.
std::shared_ptr<const VertexTripletsModel> broad_model(const Bounds3& bounds, int count) {
  RandomStream random(2);
  CellKnowledge cell{.share = 1};
  const float size = bounds.diagonal();
  for (const VertexKind before : {VertexKind::sensor, VertexKind::surface}) {
    ConditionalMixtures<6>::Run run{{before, Event::smooth_reflect, VertexKind::surface}, {}};
    for (int k = 0; k < count; ++k) {
      statistics::Gaussian<9> gaussian;
      for (double& x : gaussian.mean) x = size * between(-0.1f, 0.1f, random);
      statistics::Matrix<9> l = statistics::Matrix<9>::Identity();
      for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < row; ++column) l(row, column) = between(-0.2f, 0.2f, random);
      }
      gaussian.covariance = 0.25 * size * size * l * l.transpose();
      run.components.push_back(make_component<6>(0.5 / count, gaussian));
    }
    cell.triplets.push_back(std::move(run));
  }
  const ModelKind kind{.environment = {10 * size}};
  return std::make_shared<VertexTripletsModel>(kind, Octree({bounds.center(), size}),
                                               std::vector{cell}, CameraMixture(), 0);
}

std::vector<Measurement> answers(const Registry& registry, int count, int repeats) {
  const std::string config = scene_entry("cornell-box") + "\nbudget: { spp: 1 }\n";
  const RenderConfig loaded = build_render_config(parse_yaml(config, "benchmark"), registry).config;
  const Scene scene(loaded.scene);
  const VertexTripletsGuider guider({});
  const auto model = broad_model(scene.bounds(), count);
  const auto queries = guide_queries(scene, conformance::frame_of(guider, model), kVertices);
  const BoundGuider bound(guider, model);
  const auto named = [&](const char* what) { return fmt::format("triplets.{}.k{}", what, count); };
  Measurement pdf{named("pdf_ns"), "ns", {}}, sample{named("sample_ns"), "ns", {}},
      query{named("query_ns"), "ns", {}}, allocations{named("allocations"), "1", {}};
  for (int i = 0; i < repeats; ++i) {
    const GuideCosts costs = measure_costs(bound, queries);
    pdf.runs.push_back(costs.pdf_ns);
    sample.runs.push_back(costs.sample_ns);
    query.runs.push_back(costs.query_ns);
    allocations.runs.push_back(static_cast<double>(costs.allocations));
  }
  return {query, sample, pdf, allocations};
}

/// Measures shares and sizes of a render with a budget of `seconds`.
std::vector<Measurement> render(const std::string& scene, double seconds, const Registry& registry,
                                int repeats) {
  const std::string config = learning_config(scene, "vertex_triplets", "vertex_triplets", seconds);
  const LoadedConfig loaded = build_render_config(parse_yaml(config, "benchmark"), registry);
  RenderJob job(loaded.config);
  const RenderResult result = job.run();
  if (result.model == nullptr) throw RunError("nothing was learned");
  const auto named = [&](const char* what) { return fmt::format("triplets.{}.{}", what, scene); };
  const auto& guider = *loaded.config.integrator->guiding()->resolved_methods().front().guider;
  const GuidingFrame frame = conformance::frame_of(guider, result.model);
  const RenderRate rate(loaded.config, job.scene(), kSamples);
  const GuidedSpeed speed = guided_speed(rate, frame, std::min(repeats, kMostRenders));
  const ModelInfo info = result.model->info();
  std::vector<Measurement> all{
      {named("learn_share"),
       "1",
       {result.times.update / (result.times.training + result.times.update)}},
      {named("added_ns"), "ns", speed.added_ns},
      {named("rays_ratio"), "1", speed.rays_ratio},
      {named("model_mib"), "MiB", {static_cast<double>(info.bytes) / (1 << 20)}}};
  for (const ModelFact& fact : info.facts) {
    if (fact.name == "samples") {
      all.push_back({named("samples_mib"), "MiB", {std::stod(fact.value)}});
    }
  }
  return all;
}

}  // namespace

std::vector<Group> triplets_groups(const std::shared_ptr<const Registry>& registry,
                                   double seconds) {
  std::vector<Group> groups{{"triplets.parts", [registry](int repeats) {
                               std::vector<Measurement> all{em_step(repeats)};
                               for (const int count : {8, 32, 128}) {
                                 for (Measurement& m : answers(*registry, count, repeats)) {
                                   all.push_back(std::move(m));
                                 }
                               }
                               return all;
                             }}};
  for (const char* scene : {"metalwork", "mirror-chamber", "pool", "haze", "volume-caustics"}) {
    groups.push_back(
        {fmt::format("triplets.{}", scene), [=](int repeats) {
           const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
           tbb::task_arena arena(kThreads);
           return arena.execute([&] { return render(scene, seconds, *registry, repeats); });
         }});
  }
  return groups;
}

}  // namespace pharos::bench
