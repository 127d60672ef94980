// The path tracer's rays a second over Embree's own rate in the same scene, interleaved. The path
// tracer runs at depth 10 without roulette and counts all radiance and shadow rays. Embree's rate
// is that of rtcIntersect1 on rays from random points of the scene's box into random directions,
// made beforehand, on as many threads.

#include <chrono>

#include <pharos/core/parallel.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>

#include "bench.h"
#include "bench_scenes.h"
#include "raw_embree.h"
#include "renders.h"

namespace pharos::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Ray> random_rays(const Bounds3& box, std::size_t count) {
  std::vector<Ray> rays(count);
  RandomStream random(1);
  for (Ray& ray : rays) {
    const Vec2 xy = random.next_2d();
    ray.origin = box.low + Vec3{xy.x, xy.y, random.next_1d()} * box.extent();
    ray.direction = warp::sphere_from_square(random.next_2d());
  }
  return rays;
}

/// Millions of rays a second.
double embree_rate(const RawEmbree& embree, const std::vector<Ray>& rays) {
  constexpr std::size_t kChunk = 1 << 14;
  const auto start = Clock::now();
  const std::size_t chunks = rays.size() / kChunk;
  parallel_for(chunks, [&](std::size_t c) {
    embree.intersect_all({rays.data() + c * kChunk, kChunk});
  });
  return static_cast<double>(chunks * kChunk) / seconds_since(start) * 1e-6;
}

double path_rate(RenderJob& job) {
  const RenderResult result = job.run();
  return static_cast<double>(result.counters.rays) / result.times.rendering * 1e-6;
}

std::vector<Measurement> bench_scene(const std::string& name, const std::string& config,
                                     int repeats) {
  const LoadedConfig loaded = testing::config_from(config);
  RenderJob job(loaded.config);
  const RawEmbree embree(job.scene());
  const std::vector<Ray> rays = random_rays(job.scene().bounds(), 1 << 22);
  Measurement ratio{"rays." + name + ".ratio_to_embree", "1", {}};
  Measurement paths{"rays." + name + ".mrays", "Mrays/s", {}};
  Measurement raw{"rays." + name + ".embree_mrays", "Mrays/s", {}};
  path_rate(job), embree_rate(embree, rays);  // warm-up
  for (int i = 0; i < repeats; ++i) {
    paths.runs.push_back(path_rate(job));
    raw.runs.push_back(embree_rate(embree, rays));
    ratio.runs.push_back(paths.runs.back() / raw.runs.back());
  }
  return {ratio, paths, raw};
}

const std::string kPath = R"(
film: { width: 256, height: 256, filter: box }
budget: { spp: 64 }
sampler: independent
integrator: { type: path, max_depth: 10, roulette: off }
)";

}  // namespace

std::vector<Measurement> bench_rays(int repeats) {
  std::vector<Measurement> all =
      bench_scene("cornell-box", scene_entry("cornell-box") + kPath, repeats);
  const SphereField field;
  for (Measurement& m : bench_scene("spheres-300k", field.entry() + kPath, repeats)) {
    all.push_back(m);
  }
  return all;
}

}  // namespace pharos::bench
