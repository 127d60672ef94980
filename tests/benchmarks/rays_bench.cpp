// Rays per second of the path tracer, relative to Embree's own rate in the same scene. Both are
// measured in turns. The path tracer runs at depth 10 without Russian roulette, and all radiance
// and shadow rays are counted. Embree's rate is the rate of rtcIntersect1 for rays from random
// points of the scene's bounding box in random directions. These rays are generated beforehand and
// traced on the same number of threads.

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

/// Returns millions of rays per second.
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
budget: { spp: 32 }
sampler: independent
integrator: { type: path, max_depth: 10, roulette: off }
)";

/// A box of fog around a ball, under a lamp.
const std::string kFog = R"(
scene:
  media:
    fog: { type: homogeneous, scattering: [0.5, 0.4, 0.3], absorption: 0.05, phase: { type: henyey_greenstein, g: 0.5 } }
  shapes:
    - { type: quad, material: { type: diffuse, reflectance: 0.6 }, to_world: [ { scale: 4 }, { rotate: { axis: [1, 0, 0], degrees: -90 } } ] }
    - { type: quad, material: { type: diffuse, reflectance: 0 }, emitter: { type: area, radiance: 30 }, to_world: [ { scale: 0.5 }, { rotate: { axis: [1, 0, 0], degrees: 90 } }, { translate: [0, 3.5, 0] } ] }
    - { type: box, material: pass_through, interior: fog, to_world: [ { scale: 1.2 }, { translate: [0, 1.21, 0] } ] }
    - { type: sphere, center: [0, 0.6, 0], radius: 0.4 }
  sensor: { type: perspective, fov: 40, to_world: { look_at: { origin: [0, 1.6, 5], target: [0, 0.8, 0], up: [0, 1, 0] } } }
)";

/// Six dark walls. The only lamp is behind one of them and faces away, so no shadow ray is traced:
/// the time of a vertex is the time of a radiance ray and of scattering.
const std::string kDarkRoom = R"(
scene:
  materials: { wall: { type: diffuse, reflectance: [0.4, 0.3, 0.26] } }
  shapes:
    - { type: box, flip_normals: true, material: wall, to_world: [ { scale: [1.5, 1.1, 1] } ] }
    - { type: quad, material: wall, emitter: { type: area, radiance: 10 }, to_world: [ { scale: 0.3 }, { translate: [0, 0, 2] } ] }
  sensor: { type: perspective, fov: 60, to_world: { look_at: { origin: [0, 0, 0.9], target: [0, 0, 0], up: [0, 1, 0] } } }
)";

/// Measures vertices per second of unguided paths.
Measurement dark_room(int repeats) {
  RenderJob job(testing::config_from(kDarkRoom + kPath).config);
  Measurement vertices{"rays.dark-room.mvertices", "1e6/s", {}};
  job.run();  // warm-up
  for (int i = 0; i < repeats; ++i) {
    const RenderResult result = job.run();
    vertices.runs.push_back(1e-6 * static_cast<double>(result.counters.vertices) /
                            result.times.rendering);
  }
  return vertices;
}

/// Measures paths from the lights per second.
Measurement light_paths(const std::string& scene, int repeats) {
  const std::string config = scene + R"(
film: { width: 256, height: 256, filter: box }
budget: { spp: 16 }
sampler: independent
integrator: { type: light, max_depth: 10 }
)";
  RenderJob job(testing::config_from(config).config);
  Measurement paths{"light.paths_per_s", "1/s", {}};
  job.run();  // warm-up
  for (int i = 0; i < repeats; ++i) {
    const RenderResult result = job.run();
    paths.runs.push_back(static_cast<double>(result.counters.paths) / result.times.rendering);
  }
  return paths;
}

}  // namespace

std::vector<Measurement> bench_rays(int repeats) {
  std::vector<Measurement> all =
      bench_scene("cornell-box", scene_entry("cornell-box") + kPath, repeats);
  const SphereField field;
  for (Measurement& m : bench_scene("spheres-300k", field.entry() + kPath, repeats)) {
    all.push_back(m);
  }
  for (Measurement& m : bench_scene("fog", kFog + kPath, repeats)) all.push_back(m);
  all.push_back(dark_room(repeats));
  all.push_back(light_paths(scene_entry("cornell-box"), repeats));
  return all;
}

}  // namespace pharos::bench
