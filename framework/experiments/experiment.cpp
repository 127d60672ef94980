#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/version.h>
#include <pharos/experiments/content_key.h>
#include <pharos/experiments/density_pictures.h>
#include <pharos/experiments/experiment.h>
#include <pharos/experiments/peak_memory.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// Measures an image in progress whenever its own samples have doubled.
class CheckpointLog {
 public:
  explicit CheckpointLog(const Image& reference) : reference_(reference) {}

  void look(const RenderSnapshot& snapshot) {
    const double samples = snapshot.progress.samples_per_pixel;
    if (snapshot.progress.training) {
      training_samples_ = samples;
      return;
    }
    if (samples - training_samples_ < next_) return;
    next_ = 2 * (samples - training_samples_);
    checkpoints_.push_back({samples, snapshot.progress.seconds,
                            measure(snapshot.image(), reference_, checkpoint_metrics())});
  }

  /// All of them, with the end of the run.
  std::vector<Checkpoint> finish(const RunRecord& record) {
    if (checkpoints_.empty() || checkpoints_.back().samples_per_pixel < record.samples_per_pixel) {
      Checkpoint end{record.samples_per_pixel, record.seconds(), {}};
      for (const Metric metric : checkpoint_metrics()) end.errors[metric] = record.errors[metric];
      checkpoints_.push_back(end);
    }
    return std::move(checkpoints_);
  }

 private:
  const Image& reference_;
  std::vector<Checkpoint> checkpoints_;
  double training_samples_ = 0;
  double next_ = 0;  ///< samples of the final image at the next checkpoint
};

/// Tells how far an experiment is; the time left by what runs took so far.
class RunCounter {
 public:
  RunCounter(std::size_t count, const ExperimentControl& control)
      : count_(count), control_(control) {}

  void skip() { ++done_; }
  void finish(const RunRecord& record) {
    ++done_;
    ++rendered_;
    if (!control_.on_message) return;
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double left = seconds / rendered_ * static_cast<double>(count_ - done_);
    control_.on_message(fmt::format(
        "[{}/{}] {}, {}, seed {}: relMSE {:.4g}, {:.6g} samples a pixel, {:.1f} s; {:.0f} s left",
        done_, count_, record.scene, record.method, record.seed,
        record.errors[Metric::relative_mse], record.samples_per_pixel, record.seconds(), left));
  }

 private:
  std::size_t count_, done_ = 0;
  int rendered_ = 0;
  const ExperimentControl& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Runner {
 public:
  Runner(const ExperimentConfig& config, const ExperimentPlan& plan, const Registry& registry,
         const ExperimentControl& control)
      : registry_(registry), control_(control) {
    results_.config = config;
    results_.plan = plan;
    results_.run_count = plan.cells.size() * config.seeds;
  }

  ExperimentResults run() {
    results_.stopped = !find_references();
    RunCounter counter(results_.run_count, control_);
    const std::uint64_t first = results_.config.first_seed;
    for (std::uint64_t seed = first; seed < first + results_.config.seeds; ++seed) {
      for (const PlannedCell& cell : results_.plan.cells) {
        if (results_.stopped) return std::move(results_);
        make(cell, seed, counter);
      }
    }
    return std::move(results_);
  }

 private:
  bool find_references() {
    const fs::path cache =
        results_.config.cache.empty() ? default_reference_cache() : results_.config.cache;
    for (std::size_t s = 0; s < results_.config.scenes.size(); ++s) {
      const auto report = [&](std::uint32_t part, std::uint32_t parts) {
        if (!control_.on_message) return;
        control_.on_message(fmt::format("{}: reference, part {} of {}",
                                        results_.config.scenes[s].name, part + 1, parts));
      };
      auto reference =
          find_or_render(results_.plan.references[s], cache, registry_, control_.render, report);
      if (!reference) return false;
      results_.references.push_back(std::move(*reference));
    }
    return true;
  }

  std::string key_of(const PlannedCell& cell, std::uint64_t seed) const {
    return content_key(
        fmt::format("{} {} {} {}", cell.key, results_.references[cell.scene].key, seed, version()));
  }

  /// Makes a run, unless its record is there.
  void make(const PlannedCell& cell, std::uint64_t seed, RunCounter& counter) {
    const std::string& scene = results_.config.scenes[cell.scene].name;
    const std::string& method = results_.config.methods[cell.method].name;
    const fs::path file = results_.run_file(scene, method, seed, ".json");
    std::optional<RunRecord> record = load_record(file);
    if (record && record->key == key_of(cell, seed)) {
      counter.skip();
    } else {
      record = render(cell, seed);
      if (!record) {
        results_.stopped = true;
        return;
      }
      save_record(*record, file);
      counter.finish(*record);
    }
    results_.records.push_back(std::move(*record));
  }

  /// Empty when it was stopped.
  std::optional<RunRecord> render(const PlannedCell& cell, std::uint64_t seed) {
    reset_peak_memory();
    const LoadedConfig loaded = build_run(cell.config, seed, registry_);
    const Image& reference = results_.references[cell.scene].image;
    RenderJob job(loaded.config);
    CheckpointLog checkpoints(reference);
    RenderControl control = control_.render;
    control.on_pass = [&](const RenderSnapshot& snapshot) { checkpoints.look(snapshot); };
    const RenderResult result = job.run(control);
    if (result.stopped) return std::nullopt;
    RunRecord record{.key = key_of(cell, seed),
                     .version = version(),
                     .scene = results_.config.scenes[cell.scene].name,
                     .method = results_.config.methods[cell.method].name,
                     .seed = seed,
                     .samples_per_pixel = result.samples_per_pixel,
                     .times = result.times,
                     .rays = result.counters.rays,
                     .invalid_paths = result.counters.invalid_paths,
                     .model_bytes = result.model_bytes,
                     .peak_bytes = peak_memory(),
                     .errors = measure(result.image, reference),
                     .checkpoints = {}};
    record.checkpoints = checkpoints.finish(record);
    keep_images(record, result, job.scene());
    return record;
  }

  void keep_images(const RunRecord& record, const RenderResult& result, const Scene& scene) const {
    const auto file = [&](const std::string& extension) {
      return results_.run_file(record.scene, record.method, record.seed, extension);
    };
    fs::create_directories(file("").parent_path());
    const bool first = record.seed == results_.config.first_seed;
    if (first || results_.config.images == KeptImages::all) {
      write_exr(select_layers(result.image, {}), file(".exr"), {{"pharos:version", version()}});
    }
    if (!first || result.model == nullptr) return;
    const Image& image = result.image;
    for (const DensityPicture& picture :
         density_pictures(*result.model, scene, image.width(), image.height())) {
      write_exr(picture.image, file("." + picture.name + ".exr"),
                {{"pharos:caption", picture.caption}});
    }
  }

  const Registry& registry_;
  const ExperimentControl& control_;
  ExperimentResults results_;
};

}  // namespace

fs::path ExperimentResults::run_file(const std::string& scene, const std::string& method,
                                     std::uint64_t seed, const std::string& extension) const {
  return folder() / "runs" / scene / method / fmt::format("seed-{}{}", seed, extension);
}

ExperimentResults run_experiment(const ExperimentConfig& config, const ExperimentPlan& plan,
                                 const Registry& registry, const ExperimentControl& control) {
  return Runner(config, plan, registry, control).run();
}

}  // namespace pharos
