#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/file_lock.h>
#include <pharos/core/version.h>
#include <pharos/experiments/pictures/density_pictures.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/experiment.h>
#include <pharos/experiments/runner/machine.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/peak_memory.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// Measures an image in progress whenever the number of its own samples has doubled.
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

  double training_samples() const { return training_samples_; }

  /// Returns all checkpoints, including the end of the run.
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
  double next_ = 0;  ///< samples of the final image before the next checkpoint
};

/// Reports the progress of an experiment. The remaining time is estimated from the runs so far.
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
  Runner(const ExperimentConfig& config, ExperimentPlan plan, const Registry& registry,
         const ExperimentControl& control)
      : registry_(registry), control_(control) {
    results_.config = config;
    results_.plan = std::move(plan);
    for (const PlannedCell& cell : results_.plan.cells) {
      results_.run_count += config.seeds_of(config.methods[cell.method]);
    }
  }

  ExperimentResults run() {
    for (const ExperimentScene& scene : results_.config.left_out) {
      tell(fmt::format("{}: left out, because '{}' does not exist", scene.name,
                       scene.config.string()));
    }
    results_.stopped = !find_references();
    std::vector<Run> runs = all_runs();
    RunCounter counter(runs.size(), control_);
    for (Run& run : runs) {
      run.record = load(run);
      if (run.record) counter.skip();
    }
    for (Run& run : runs) {
      if (results_.stopped) break;
      if (run.record) continue;
      run.record = render(run);
      if (run.record) counter.finish(*run.record);
      results_.stopped = !run.record;
    }
    for (Run& run : runs) {
      if (run.record) results_.records.push_back(std::move(*run.record));
    }
    return std::move(results_);
  }

 private:
  struct Run {
    const PlannedCell* cell;
    std::uint64_t seed;
    std::optional<RunRecord> record;
  };

  /// Returns the runs whose reference exists, in the order of execution.
  std::vector<Run> all_runs() const {
    std::vector<Run> runs;
    const std::uint64_t first = results_.config.first_seed;
    for (std::uint64_t seed = first; seed < first + results_.config.seeds; ++seed) {
      for (const PlannedCell& cell : results_.plan.cells) {
        const bool has_seed =
            seed < first + results_.config.seeds_of(results_.config.methods[cell.method]);
        if (has_seed && cell.scene < results_.references.size()) runs.push_back({&cell, seed, {}});
      }
    }
    return runs;
  }

  void tell(const std::string& message) const {
    if (control_.on_message) control_.on_message(message);
  }

  bool find_references() {
    const fs::path cache =
        results_.config.cache.empty() ? default_reference_cache() : results_.config.cache;
    for (std::size_t s = 0; s < results_.config.scenes.size(); ++s) {
      const std::string& scene = results_.config.scenes[s].name;
      const PlannedReference& planned = results_.plan.references[s];
      const auto report = [&](std::uint32_t part, std::uint32_t parts) {
        tell(fmt::format("{}: reference, part {} of {}", scene, part + 1, parts));
      };
      auto reference = find_or_render(planned, cache, registry_, control_.render, report);
      if (!reference) return false;
      if (planned.parts > 0 && reference->build != build_of(planned)) {
        tell(
            fmt::format("{}: the reference was rendered by another build of Pharos; remove '{}' to "
                        "have it made anew",
                        scene, reference->file.string()));
      }
      results_.references.push_back(std::move(*reference));
    }
    return true;
  }

  std::string build_of(const PlannedReference& planned) const {
    return build_key(build_run(planned.config, 0, registry_).resolved, registry_);
  }

  const std::string& scene_of(const Run& run) const {
    return results_.config.scenes[run.cell->scene].name;
  }
  const std::string& method_of(const Run& run) const {
    return results_.config.methods[run.cell->method].name;
  }
  fs::path file_of(const Run& run, const std::string& extension) const {
    return results_.run_file(scene_of(run), method_of(run), run.seed, extension);
  }
  bool keeps_image(const Run& run) const {
    return run.seed == results_.config.first_seed || results_.config.images == KeptImages::all;
  }

  /// Returns the key of a run. The result of a run with a time budget also depends on the machine.
  std::string key_of(const Run& run) const {
    std::string key =
        fmt::format("{} {} {}", run.cell->key, results_.references[run.cell->scene].key, run.seed);
    const ExperimentScene& scene = results_.config.scenes[run.cell->scene];
    if (results_.config.budget_of(scene).seconds) {
      key += fmt::format(" {} {}", thread_count(), processor_name());
    }
    return content_key(key);
  }

  /// Returns the record of an earlier run with the same key, if the files that must be kept exist.
  std::optional<RunRecord> load(const Run& run) const {
    std::optional<RunRecord> record = load_record(file_of(run, ".json"));
    if (!record || record->key != key_of(run)) return std::nullopt;
    if (keeps_image(run) && !fs::exists(file_of(run, ".exr"))) return std::nullopt;
    return record;
  }

  /// Makes a run and writes its files. Returns empty if it was stopped.
  std::optional<RunRecord> render(const Run& run) {
    remove_run(file_of(run, ""));
    PeakMemory peak;
    const LoadedConfig loaded = build_run(run.cell->config, run.seed, registry_);
    const Image& reference = results_.references[run.cell->scene].image;
    RenderJob job(loaded.config);
    CheckpointLog checkpoints(reference);
    RenderControl control = control_.render;
    control.on_pass = [&](const RenderSnapshot& snapshot) {
      peak.leave_out([&] { checkpoints.look(snapshot); });
    };
    const RenderResult result = job.run(control);
    if (result.stopped) return std::nullopt;
    RunRecord record = record_of(run, result);
    record.peak_bytes = peak.bytes();
    record.training_samples = checkpoints.training_samples();
    const Display display{loaded.config.output.exposure};
    record.errors = measure(result.image, reference, display);
    record.checkpoints = checkpoints.finish(record);
    keep_images(run, result, job.scene(), display);
    save_record(record, file_of(run, ".json"));
    return record;
  }

  RunRecord record_of(const Run& run, const RenderResult& result) const {
    return {.key = key_of(run),
            .version = version(),
            .threads = thread_count(),
            .processor = processor_name(),
            .scene = scene_of(run),
            .method = method_of(run),
            .seed = run.seed,
            .samples_per_pixel = result.samples_per_pixel,
            .training_samples = 0,
            .times = result.times,
            .rays = result.counters.rays,
            .invalid_paths = result.counters.invalid_paths,
            .gain = result.gain,
            .model_bytes = result.model_bytes,
            .peak_bytes = {},
            .errors = {},
            .checkpoints = {}};
  }

  void keep_images(const Run& run, const RenderResult& result, const Scene& scene,
                   const Display& display) const {
    fs::create_directories(file_of(run, "").parent_path());
    if (keeps_image(run)) {
      write_exr(select_layers(result.image, {}), file_of(run, ".exr"),
                {{"pharos:version", version()},
                 {"pharos:exposure", fmt::format("{}", display.exposure)}});
    }
    if (run.seed != results_.config.first_seed || result.model == nullptr) return;
    const Image& image = result.image;
    for (const DensityPicture& picture :
         density_pictures(*result.model, scene, image.width(), image.height())) {
      write_exr(picture.image, file_of(run, "." + picture.name + ".exr"),
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

const RunRecord* ExperimentResults::find(const std::string& scene, const std::string& method,
                                         std::uint64_t seed) const {
  for (const RunRecord& record : records) {
    if (record.scene == scene && record.method == method && record.seed == seed) return &record;
  }
  return nullptr;
}

ExperimentResults run_experiment(const ExperimentConfig& config, ExperimentPlan plan,
                                 const Registry& registry, const ExperimentControl& control) {
  const FileLock lock = claim_folder(config.output, config.source);
  return Runner(config, std::move(plan), registry, control).run();
}

}  // namespace pharos
