#include "render_rate.h"

#include <atomic>
#include <chrono>

#include <pharos/core/parallel.h>

#include "thread_time.h"

namespace pharos::bench {
namespace {

constexpr std::uint32_t kUnitSamples = 2;  ///< samples per pixel in a work unit

}  // namespace

RenderRate::RenderRate(const RenderConfig& config, const Scene& scene, std::uint32_t samples)
    : config_(config),
      samples_(samples),
      sensor_(scene.sensor().prepare(config.film.width, config.film.height)),
      integrator_(config.integrator->prepare(
          {scene, *sensor_, config.film.width, config.film.height, config.film.window()})),
      sampler_(config.sampler->prepare({config.film.width, config.film.height},
                                       {config.seed, samples}, nullptr)) {}

Speed RenderRate::measure(const GuidingFrame* guiding) const {
  const Film film(config_.film.window(), config_.film.filter, config_.film.least_weight);
  std::atomic<std::uint64_t> rays = 0, vertices = 0;
  std::atomic<double> processor_ns = 0;
  // The iteration after training, which has other random numbers than the training iterations.
  const std::uint32_t iteration = config_.integrator->guiding()->training.iterations;
  const auto start = std::chrono::steady_clock::now();
  parallel_for(samples_ / kUnitSamples, [&](std::size_t i) {
    const WorkUnit unit{.pixels = config_.film.window(),
                        .iteration = iteration,
                        .first_sample = static_cast<std::uint32_t>(i) * kUnitSamples,
                        .sample_count = kUnitSamples};
    WorkResult result{.film = film.make_tile(unit.pixels)};
    const double before = thread_ns();
    integrator_->render(unit, {*sampler_, config_.seed, guiding, false}, result);
    processor_ns += thread_ns() - before;
    rays += result.counters.rays;
    vertices += result.counters.vertices;
  });
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return {1e-6 * static_cast<double>(rays) / taken.count(),
          processor_ns / static_cast<double>(vertices)};
}

GuidedSpeed guided_speed(const RenderRate& rate, const GuidingFrame& guiding, int repeats) {
  rate.measure(nullptr), rate.measure(&guiding);  // warm-up
  GuidedSpeed result;
  for (int i = 0; i < repeats; ++i) {
    const Speed unguided = rate.measure(nullptr), guided = rate.measure(&guiding);
    result.rays_ratio.push_back(guided.mrays / unguided.mrays);
    result.added_ns.push_back(guided.vertex_ns - unguided.vertex_ns);
  }
  return result;
}

}  // namespace pharos::bench
