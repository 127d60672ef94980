// How the cost of a ray and of a vertex grows with the work: with the number of triangles, the
// number of lights, and the depth of paths. Figures are named growth.PARAMETER.VALUE.FIGURE, so
// that growth_plots.h can draw them.

#include <chrono>
#include <fstream>

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

std::string path_config(int samples, int depth) {
  return fmt::format(R"(
film: {{ width: 192, height: 192, filter: box }}
budget: {{ spp: {} }}
sampler: independent
integrator: {{ type: path, max_depth: {}, roulette: off }}
)",
                     samples, depth);
}

/// Returns the resident memory of this process [bytes].
double resident_bytes() {
  constexpr double kPage = 4096;
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return kPage * resident;
}

/// The time of a thread for each ray and each vertex [ns].
struct Times {
  double ray, vertex;
};
Times times_of(RenderJob& job) {
  const RenderResult result = job.run();
  const double thread_ns = 1e9 * kThreads * result.times.rendering;
  return {thread_ns / static_cast<double>(result.counters.rays),
          thread_ns / static_cast<double>(result.counters.vertices)};
}

/// Measures rays in 220 spheres with different numbers of triangles, the seconds to load and build
/// the scene, and its memory.
std::vector<Measurement> growth_of_triangles(int repeats) {
  std::vector<Measurement> all;
  for (const int rings : {2, 4, 12, 34, 76}) {
    const SphereField field(220, rings);
    const auto named = [&](const char* figure) {
      return fmt::format("growth.triangles.{}.{}", field.triangles(), figure);
    };
    Measurement ray{named("ray_ns"), "ns", {}}, build{named("load_and_build_s"), "s", {}},
        memory{named("bytes_per_triangle"), "B", {}};
    const double before = resident_bytes();
    const auto start = std::chrono::steady_clock::now();
    const LoadedConfig loaded = testing::config_from(field.entry() + path_config(16, 10));
    RenderJob job(loaded.config);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    build.runs.push_back(taken.count());
    memory.runs.push_back((resident_bytes() - before) / static_cast<double>(field.triangles()));
    times_of(job);  // warm-up
    for (int i = 0; i < repeats; ++i) ray.runs.push_back(times_of(job).ray);
    all.insert(all.end(), {ray, build});
    // Small scenes fit into memory that the process holds anyway.
    if (field.triangles() > 500'000) all.push_back(memory);
  }
  return all;
}

/// Returns a floor below a square grid of lamps, each of which is an object of its own.
std::string lamps(int per_side) {
  std::string scene =
      "scene:\n  shapes:\n    - { type: quad, to_world: [ { scale: 4 }, { rotate: { axis: [1, 0, "
      "0], degrees: -90 } } ] }\n";
  const double spacing = 4.0 / per_side;
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      scene += fmt::format(
          "    - {{ type: quad, emitter: {{ type: area, radiance: 10 }}, to_world: [ {{ scale: {} "
          "}}, {{ rotate: {{ axis: [1, 0, 0], degrees: 90 }} }}, {{ translate: [{}, 1.5, {}] }} ] "
          "}}\n",
          0.2 * spacing, (i + 0.5) * spacing - 2, (j + 0.5) * spacing - 2);
    }
  }
  return scene +
         "  sensor: { type: perspective, fov: 60, to_world: { look_at: { origin: [0, 1, 4], "
         "target: [0, 0.3, 0], up: [0, 1, 0] } } }\n";
}

std::vector<Measurement> growth_of_lights(int repeats) {
  std::vector<Measurement> all;
  for (const int per_side : {1, 3, 10, 32, 100}) {
    RenderJob job(testing::config_from(lamps(per_side) + path_config(32, 10)).config);
    Measurement ray{fmt::format("growth.lights.{}.ray_ns", per_side * per_side), "ns", {}};
    times_of(job);  // warm-up
    for (int i = 0; i < repeats; ++i) ray.runs.push_back(times_of(job).ray);
    all.push_back(ray);
  }
  return all;
}

std::vector<Measurement> growth_of_depth(int repeats) {
  std::vector<Measurement> all;
  for (const int depth : {2, 4, 8, 16, 32, 64}) {
    const std::string config = scene_entry("cornell-box") + path_config(128 / depth, depth);
    RenderJob job(testing::config_from(config).config);
    Measurement vertex{fmt::format("growth.depth.{}.vertex_ns", depth), "ns", {}};
    times_of(job);  // warm-up
    for (int i = 0; i < repeats; ++i) vertex.runs.push_back(times_of(job).vertex);
    all.push_back(vertex);
  }
  return all;
}

}  // namespace

std::vector<Measurement> bench_growth(int repeats) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
  tbb::task_arena arena(kThreads);
  std::vector<Measurement> all;
  arena.execute([&] {
    for (const auto measure : {growth_of_triangles, growth_of_lights, growth_of_depth}) {
      for (Measurement& m : measure(repeats)) all.push_back(std::move(m));
    }
  });
  return all;
}

}  // namespace pharos::bench
