// Measures the size of path records and the share of time that a path tracer takes to write them,
// on one thread.

#include <pharos/rendering/film.h>
#include <pharos/rendering/render_job.h>

#include "bench.h"
#include "bench_scenes.h"
#include "renders.h"
#include "thread_time.h"

namespace pharos::bench {
namespace {

constexpr int kEdge = 32;
constexpr std::uint32_t kSamples = 4;  // the size of a work unit whose paths are recorded
constexpr std::uint32_t kUnits = 40;

std::size_t bytes_of(const PathLog& log) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < log.size(); ++i) {
    bytes += log[i].vertices.size_bytes() + log[i].light_samples.size_bytes();
  }
  return log.size() == 0 ? 0 : bytes + log[0].log_techniques.size_bytes();
}

/// Renders the same paths with and without records.
class RecordedRender {
 public:
  explicit RecordedRender(const RenderConfig& config)
      : config_(config),
        job_(config),
        sensor_(job_.scene().sensor().prepare(kEdge, kEdge)),
        integrator_(config.integrator->prepare({job_.scene(), *sensor_, kEdge, kEdge})),
        sampler_(
            config.sampler->prepare({kEdge, kEdge}, {config.seed, kUnits * kSamples}, nullptr)),
        film_(kEdge, kEdge, config.film.filter) {}

  /// Renders all work units and returns the time [ns].
  double time(bool record) {
    const double start = thread_ns();
    for (std::uint32_t i = 0; i < kUnits; ++i) {
      // The memory of logs is used again, as in a render.
      work_ = {.film = film_.make_tile({0, 0, kEdge, kEdge}), .log = std::move(work_.log)};
      work_.log.clear();
      integrator_->render(
          {.pixels = {0, 0, kEdge, kEdge}, .first_sample = i * kSamples, .sample_count = kSamples},
          {.sampler = *sampler_, .seed = config_.seed, .record = record}, work_);
    }
    return thread_ns() - start;
  }
  /// Returns the bytes per path of the last work unit with records.
  double bytes_per_path() const {
    return static_cast<double>(bytes_of(work_.log)) / static_cast<double>(work_.log.size());
  }

 private:
  RenderConfig config_;
  RenderJob job_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> integrator_;
  std::unique_ptr<const PreparedSampler> sampler_;
  Film film_;
  WorkResult work_{.film = film_.make_tile({0, 0, kEdge, kEdge})};
};

}  // namespace

std::vector<Measurement> bench_records(int repeats) {
  std::vector<Measurement> all;
  for (const std::string scene : {"cornell-box", "pool"}) {
    const std::string config = scene_entry(scene) + R"(
film: { width: 32, height: 32, filter: box }
budget: { spp: 4 }
sampler: independent
integrator: { type: path, max_depth: 10, roulette: off }
)";
    RecordedRender render(testing::config_from(config).config);
    Measurement bytes{"records." + scene + ".bytes", "B/path", {}};
    Measurement share{"records." + scene + ".write_share", "1", {}};
    render.time(true);  // warm-up
    for (int i = 0; i < repeats; ++i) {
      const double without = render.time(false), with = render.time(true);
      share.runs.push_back(1 - without / with);
      bytes.runs.push_back(render.bytes_per_path());
    }
    all.push_back(bytes);
    all.push_back(share);
  }
  return all;
}

}  // namespace pharos::bench
