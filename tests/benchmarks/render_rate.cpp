#include "render_rate.h"

#include <atomic>
#include <chrono>

#include <pharos/core/parallel.h>

namespace pharos::bench {
namespace {

/// Samples per pixel in total, and in a work unit.
constexpr std::uint32_t kSamples = 32, kUnitSamples = 2;

}  // namespace

RenderRate::RenderRate(const RenderConfig& config, const Scene& scene)
    : config_(config),
      sensor_(scene.sensor().prepare(config.film.width, config.film.height)),
      integrator_(config.integrator->prepare(
          {scene, *sensor_, config.film.width, config.film.height, config.film.window()})),
      sampler_(config.sampler->prepare({config.film.width, config.film.height},
                                       {config.seed, kSamples}, nullptr)) {}

double RenderRate::mrays(const GuidingFrame* guiding) const {
  const Film film(config_.film.window(), config_.film.filter, config_.film.least_weight);
  std::atomic<std::uint64_t> rays = 0;
  // The iteration after training, which has other random numbers than the training iterations.
  const std::uint32_t iteration = config_.integrator->guiding()->training.iterations;
  const auto start = std::chrono::steady_clock::now();
  parallel_for(kSamples / kUnitSamples, [&](std::size_t i) {
    const WorkUnit unit{.pixels = config_.film.window(),
                        .iteration = iteration,
                        .first_sample = static_cast<std::uint32_t>(i) * kUnitSamples,
                        .sample_count = kUnitSamples};
    WorkResult result{.film = film.make_tile(unit.pixels)};
    integrator_->render(unit, {*sampler_, config_.seed, guiding, false}, result);
    rays += result.counters.rays;
  });
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return static_cast<double>(rays) / taken.count() * 1e-6;
}

}  // namespace pharos::bench
