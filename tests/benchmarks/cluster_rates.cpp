#include "cluster_rates.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/core/parallel.h>
#include <pharos/guiding/pipeline/guiding_state.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/integrator.h>
#include <pharos/rendering/render_job.h>

#include "thread_time.h"

namespace pharos::bench {
namespace {

constexpr std::uint32_t kIterations = 6;
constexpr std::size_t kUnitsAtATime = 32;  ///< whose results are in memory
/// Samples per pixel of a work unit, as PassSizes chooses them.
constexpr std::uint32_t kRecordedUnit = 4, kFinalUnit = 64;

/// Returns the seconds that a function takes.
template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t saved_size(GuidingState& state, void (GuidingState::*archive)(Archive&)) {
  std::ostringstream out;
  Archive saving(out);
  (state.*archive)(saving);
  return out.view().size();
}

/// Sums over the work units of an iteration.
struct Costs {
  double paths = 0;
  double trace = 0, pack = 0, unpack = 0, merge = 0, absorb = 0, update = 0;  ///< [s]
  double bytes = 0, log_bytes = 0;
};

/// A render whose steps are timed one after another.
class TimedRender {
 public:
  explicit TimedRender(const RenderConfig& config)
      : config_(config),
        job_(config),
        sensor_(job_.scene().sensor().prepare(config.film.width, config.film.height)),
        integrator_(config.integrator->prepare(
            {job_.scene(), *sensor_, config.film.width, config.film.height})),
        sampler_(config.sampler->prepare({config.film.width, config.film.height},
                                         {config.seed, 1u << kIterations}, nullptr)),
        guiding_(
            *config.integrator->guiding(),
            {.region = job_.scene().bounds(), .seed = config.seed, .window = config.film.window()}),
        tiles_(tiles_of(config.film.window(), config.film.tile)) {}

  /// Trains once more, with twice as many samples as before.
  Costs train() {
    Costs costs = render(1u << iteration_, true);
    const TrainingStage stage{iteration_, kIterations - 1 - iteration_};
    costs.update = seconds_of([&] { guiding_.update(stage); });
    ++iteration_;
    return costs;
  }
  Costs render_final_image() { return render(kFinalUnit, false); }

  /// Returns the bytes that learners keep of the paths of the last training iteration until they
  /// learn from them, by their saved state.
  double sample_bytes_per_path() const { return sample_bytes_; }
  std::size_t guide_bytes() { return saved_size(guiding_, &GuidingState::archive_guides); }

 private:
  Costs render(std::uint32_t samples, bool records) {
    const std::shared_ptr<const GuidingFrame> frame = guiding_.frame();
    const IterationContext context{*sampler_, config_.seed, frame.get(), records, records};
    Film film(config_.film.window(), config_.film.filter, config_.film.least_weight);
    const std::uint32_t chunk = std::min(samples, records ? kRecordedUnit : kFinalUnit);
    Costs costs;
    for (std::uint32_t sample = 0; sample < samples; sample += chunk) {
      for (std::size_t first = 0; first < tiles_.size(); first += kUnitsAtATime) {
        std::vector<WorkUnit> units;
        for (std::size_t t = first; t < std::min(first + kUnitsAtATime, tiles_.size()); ++t) {
          units.push_back({tiles_[t], iteration_, sample, chunk});
        }
        render(units, context, film, costs);
      }
    }
    return costs;
  }

  void render(const std::vector<WorkUnit>& units, const IterationContext& context, Film& film,
              Costs& costs) {
    std::vector<WorkResult> results;
    std::vector<double> times(units.size());
    for (const WorkUnit& unit : units) results.push_back({.film = film.make_tile(unit.pixels)});
    parallel_for(units.size(), [&](std::size_t i) {
      const double start = thread_ns();
      integrator_->render(units[i], context, results[i]);
      times[i] = 1e-9 * (thread_ns() - start);
    });
    for (std::size_t i = 0; i < units.size(); ++i) {
      costs.paths += static_cast<double>(units[i].pixels.area()) * units[i].sample_count;
      costs.trace += times[i];
      std::string bytes;
      costs.pack += seconds_of([&] { bytes = saved(results[i]); });
      costs.bytes += static_cast<double>(bytes.size());
      std::ostringstream log;
      save(log, results[i].log);
      costs.log_bytes += static_cast<double>(log.view().size());
      WorkResult received{.film = film.make_tile(units[i].pixels)};
      costs.unpack += seconds_of([&] {
        std::istringstream in(std::move(bytes));
        load(in, received);
      });
      costs.merge += seconds_of([&] { film.merge(received.film); });
      if (context.record) absorb(units[i], received.log, costs);
    }
  }

  void absorb(const WorkUnit& unit, const PathLog& log, Costs& costs) {
    const bool is_first = costs.absorb == 0;
    const std::size_t before = is_first ? saved_size(guiding_, &GuidingState::archive) : 0;
    costs.absorb += seconds_of([&] { guiding_.absorb(log); });
    if (!is_first) return;
    const double grown = static_cast<double>(saved_size(guiding_, &GuidingState::archive)) - before;
    sample_bytes_ = grown / (static_cast<double>(unit.pixels.area()) * unit.sample_count);
  }

  static std::string saved(const WorkResult& result) {
    std::ostringstream out;
    save(out, result);
    return std::move(out).str();
  }

  RenderConfig config_;
  RenderJob job_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> integrator_;
  std::unique_ptr<const PreparedSampler> sampler_;
  GuidingState guiding_;
  std::vector<PixelRect> tiles_;
  std::uint32_t iteration_ = 0;
  double sample_bytes_ = 0;
};

/// Runs `work` on `threads` threads.
template <class Work>
auto on_threads(int threads, Work&& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

/// Returns the part of the time of one thread that two threads share, if they take `two` for what
/// one takes `one` for.
double shared_part(double one, double two) {
  return std::clamp(2 * (one - two), 0.0, one);
}

}  // namespace

ClusterRates cluster_rates(const RenderConfig& config) {
  ClusterRates rates;
  TimedRender alone(config);
  Costs one, image;
  on_threads(1, [&] {
    for (std::uint32_t i = 0; i < kIterations; ++i) {
      one = alone.train();
      if (i == 0) rates.first_paths = one.paths;
      rates.updates.push_back(one.update);
    }
    image = alone.render_final_image();
  });
  const Costs two = on_threads(2, [&] {
    TimedRender render(config);
    for (std::uint32_t i = 1; i < kIterations; ++i) render.train();
    return render.train();
  });
  const double shared = shared_part(one.absorb, two.absorb);
  rates.trace = one.trace / one.paths;
  rates.log_bytes = one.log_bytes / one.paths;
  rates.sample_bytes = alone.sample_bytes_per_path();
  rates.pack = one.pack / one.paths;
  rates.unpack = one.unpack / one.paths;
  rates.absorb_serial = (one.absorb - shared + one.merge) / one.paths;
  rates.absorb_shared = shared / one.paths;
  rates.final_trace = image.trace / image.paths;
  rates.tile_bytes = image.bytes / image.paths * kFinalUnit;
  rates.tile_merge = (image.unpack + image.merge) / image.paths * kFinalUnit;
  rates.update_shared = shared_part(one.update, two.update) / one.update;
  rates.guide_bytes = static_cast<double>(alone.guide_bytes());
  return rates;
}

}  // namespace pharos::bench
