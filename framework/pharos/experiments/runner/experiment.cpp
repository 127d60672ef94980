#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/file_lock.h>
#include <pharos/experiments/runner/build_key.h>
#include <pharos/experiments/runner/child.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/experiment.h>
#include <pharos/experiments/runner/machine.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/run_order.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

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
      const std::size_t failed = results_.failed.size();
      run.record = render(run);
      if (run.record) counter.finish(*run.record);
      results_.stopped = !run.record && results_.failed.size() == failed;
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
        if (has_seed && has_reference(cell.scene)) runs.push_back({&cell, seed, {}});
      }
    }
    return runs;
  }

  bool has_reference(std::size_t scene) const {
    return scene < results_.references.size() && results_.references[scene];
  }

  void tell(const std::string& message) const {
    if (control_.on_message) control_.on_message(message);
  }
  void warn(const std::string& message) const {
    if (control_.on_warning) control_.on_warning(message);
  }

  /// Returns false if the work was stopped.
  bool find_references() {
    for (std::size_t s = 0; s < results_.config.scenes.size(); ++s) {
      const std::string& scene = results_.config.scenes[s].name;
      try {
        std::optional<Reference> reference = find_reference(scene, results_.plan.references[s]);
        if (!reference) return false;
        results_.references.push_back(std::move(reference));
      } catch (const Error& error) {
        warn(fmt::format("{}: the reference failed, so the scene has no runs: {}", scene,
                         error.what()));
        results_.failed.push_back(scene + ", reference");
        results_.references.emplace_back();
      }
    }
    return true;
  }

  /// Returns empty if the work was stopped.
  std::optional<Reference> find_reference(const std::string& scene,
                                          const PlannedReference& planned) const {
    const fs::path cache =
        results_.config.cache.empty() ? default_reference_cache() : results_.config.cache;
    const PartControl control{
        .make = [this](const PartOrder& order) { return render_part(order); },
        .report =
            [&](std::uint32_t part, std::uint32_t parts) {
              tell(fmt::format("{}: reference, part {} of {}", scene, part + 1, parts));
            },
        .warn = [this](const std::string& message) { warn(message); },
        .stop = control_.render.stop};
    std::optional<Reference> reference = find_or_render(planned, cache, registry_, control);
    if (reference && planned.parts > 0 && reference->build != planned.build) {
      tell(
          fmt::format("{}: the reference was rendered by another build of Pharos; remove '{}' to "
                      "have it made anew",
                      scene, reference->file.string()));
    }
    return reference;
  }

  /// Makes a part of a reference. Returns false if it was stopped.
  bool render_part(const PartOrder& order) const {
    if (control_.run_program.empty()) return make_part(order, registry_, control_.render);
    ChildLimits limits = results_.config.limits();
    limits.seconds.reset();  // the limit on the time is meant for runs
    const ChildEnd end = carry_out_in_child(order, results_.folder() / "reference.order", limits);
    if (!end.problem.empty()) throw RunError(end.problem);
    return !end.is_stopped;
  }

  /// Has an order carried out by a process of its own, which reads it from `file`.
  ChildEnd carry_out_in_child(const Order& order, const fs::path& file,
                              const ChildLimits& limits) const {
    fs::create_directories(file.parent_path());
    save_order(order, file);
    std::vector<std::string> command = control_.run_program;
    command.push_back(file.string());
    const ChildEnd end = run_child(command, limits, control_.render.stop);
    fs::remove(file);
    return end;
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
        fmt::format("{} {} {}", run.cell->key, results_.references[run.cell->scene]->key, run.seed);
    const ExperimentScene& scene = results_.config.scenes[run.cell->scene];
    if (results_.config.budget_of(scene).seconds) {
      key += fmt::format(" {} {}", thread_count(), processor_name());
    }
    return content_key(key);
  }

  /// Returns the record of an earlier run with the same key, if its files are as the run left them.
  /// A damaged record is moved aside.
  std::optional<RunRecord> load(const Run& run) const {
    const fs::path file = file_of(run, ".json");
    std::optional<RunRecord> record;
    try {
      record = load_record(file);
    } catch (const InputError& error) {
      warn(fmt::format("{}: {}", error.what(), moved_aside(file)));
      return std::nullopt;
    }
    if (!record || record->key != key_of(run)) return std::nullopt;
    if (keeps_image(run) && !record->files.contains(".exr")) return std::nullopt;
    for (const auto& [extension, key] : record->files) {
      const fs::path kept = file_of(run, extension);
      if (access_problem(kept).empty() && content_key_of_file(kept) == key) continue;
      warn(fmt::format("{}: missing or changed, so the run is made again", kept.string()));
      return std::nullopt;
    }
    return record;
  }

  /// Returns the order for a run.
  RunOrder order_of(const Run& run) const {
    return {.key = key_of(run),
            .scene = scene_of(run),
            .method = method_of(run),
            .seed = run.seed,
            .config = run.cell->text,
            .build = run.cell->build,
            .exposure = run.cell->exposure,
            .reference = fs::absolute(results_.references[run.cell->scene]->file),
            .stem = fs::absolute(file_of(run, "")),
            .keeps_image = keeps_image(run),
            .keeps_pictures = run.seed == results_.config.first_seed};
  }

  /// Makes a run, in a process of its own if there is a program for it. Returns empty if the run
  /// was stopped or has failed.
  std::optional<RunRecord> render(const Run& run) {
    remove_run(file_of(run, ""));
    const RunOrder order = order_of(run);
    if (control_.run_program.empty()) return make_run(order, registry_, control_.render);
    const ChildEnd end =
        carry_out_in_child(order, file_of(run, ".order"), results_.config.limits());
    // A run that had left its record before it was stopped counts.
    std::optional<RunRecord> record = end.problem.empty() ? load(run) : std::nullopt;
    if (!record && !end.is_stopped) {
      const std::string name = fmt::format("{}, {}, seed {}", order.scene, order.method, run.seed);
      warn(fmt::format("{}: failed: {}", name,
                       end.problem.empty() ? "it left no record" : end.problem));
      results_.failed.push_back(name);
    }
    return record;
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
