#include <algorithm>
#include <chrono>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/core/file_lock.h>
#include <pharos/experiments/runner/child.h>
#include <pharos/experiments/runner/experiment.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/run_order.h>
#include <pharos/experiments/runner/runs.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

/// How long a process waits before it looks again at what other processes do.
constexpr std::chrono::milliseconds kPause{1000};

/// Returns the file that a process of this user locks while it needs this machine for itself. The
/// folder for temporary files may be another one in every job of a cluster, so it is not used.
fs::path machine_lock() {
  return fmt::format("/tmp/pharos-machine-{}.lock", getuid());
}

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
      : registry_(registry),
        control_(control),
        place_(config.output, config.source, plan_key(config, plan)),
        files_(config.output, [this](const std::string& message) { warn(message); }) {
    results_.config = config;
    results_.plan = std::move(plan);
    results_.references.resize(config.scenes.size());
    for (const PlannedRun& run : planned_runs(results_.config, results_.plan)) {
      runs_.push_back({run, {}, false});
    }
    results_.run_count = runs_.size();
    is_timed_ = std::ranges::any_of(runs_, [](const Run& run) { return run.planned.is_timed; });
  }

  ExperimentResults run() {
    for (const ExperimentScene& scene : results_.config.left_out) {
      tell(fmt::format("{}: left out, because '{}' does not exist", scene.name,
                       scene.config.string()));
    }
    // What has failed before is tried again, unless others are in the middle of it.
    for (const Run& run : runs_) {
      if (place_.is_first()) files_.forget_failure(run.planned);
    }
    find_references();
    make_runs();
    for (Run& run : runs_) {
      // Others may have made it in the meantime.
      if (!run.is_settled) run.record = files_.load(run.planned);
      if (run.record) results_.records.push_back(std::move(*run.record));
    }
    return std::move(results_);
  }

 private:
  struct Run {
    PlannedRun planned;
    std::optional<RunRecord> record;
    bool is_settled = false;  ///< it has a record, it has failed, or it is impossible
  };

  void tell(const std::string& message) const {
    if (control_.on_message) control_.on_message(message);
  }
  void warn(const std::string& message) const {
    if (control_.on_warning) control_.on_warning(message);
  }
  bool is_asked_to_stop() const {
    return control_.render.stop != nullptr && control_.render.stop->load();
  }

  /// Gives other processes time. Notes whether the work shall stop.
  void wait() {
    for (int i = 0; i < 10 && !is_asked_to_stop(); ++i) std::this_thread::sleep_for(kPause / 10);
    results_.stopped |= is_asked_to_stop();
  }

  void find_references() {
    std::vector<bool> is_settled(results_.config.scenes.size());
    for (bool waits = true; waits && !results_.stopped;) {
      waits = false;
      for (std::size_t s = 0; s < is_settled.size() && !results_.stopped; ++s) {
        if (!is_settled[s]) is_settled[s] = find_reference(s);
        waits |= !is_settled[s];
      }
      if (waits && !results_.stopped) wait();
    }
  }

  /// Returns false if other processes make the reference, or if the work was stopped.
  bool find_reference(std::size_t s) {
    const std::string& scene = results_.config.scenes[s].name;
    try {
      ReferenceSearch search = search_reference(scene, results_.plan.references[s]);
      results_.stopped |= search.is_stopped;
      results_.references[s] = std::move(search.reference);
      return results_.references[s].has_value();
    } catch (const Error& error) {
      warn(fmt::format("{}: the reference failed, so the scene has no runs: {}", scene,
                       error.what()));
      results_.failed.push_back(scene + ", reference");
      return true;
    }
  }

  ReferenceSearch search_reference(const std::string& scene,
                                   const PlannedReference& planned) const {
    const PartControl control{
        .make = [this](const PartOrder& order) { return render_part(order); },
        .report =
            [&](std::uint32_t part, std::uint32_t parts) {
              tell(fmt::format("{}: reference, part {} of {}", scene, part + 1, parts));
            },
        .warn = [this](const std::string& message) { warn(message); }};
    ReferenceSearch search =
        find_or_render(planned, results_.config.reference_cache(), registry_, control);
    if (search.reference && planned.parts > 0 && search.reference->build != planned.build) {
      tell(
          fmt::format("{}: the reference was rendered by another build of Pharos; remove '{}' to "
                      "have it made anew",
                      scene, search.reference->file.string()));
    }
    return search;
  }

  /// Makes a part of a reference. Returns false if it was stopped.
  bool render_part(const PartOrder& order) const {
    std::optional<FileLock> machine;
    if (is_timed_ && !(machine = lock_machine())) return false;
    if (control_.run_program.empty()) return make_part(order, registry_, control_.render);
    ChildLimits limits = results_.config.limits();
    limits.seconds.reset();  // the limit on the time is meant for runs
    const std::string name = order.file.stem().string() + ".order";
    const ChildEnd end = carry_out_in_child(order, results_.folder() / name, limits);
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

  /// Makes the runs that are missing and that no other process makes, and waits for the others.
  void make_runs() {
    for (Run& run : runs_) {
      run.is_settled = !results_.references[run.planned.cell->scene].has_value();
    }
    RunCounter counter(runs_.size(), control_);
    for (Run& run : runs_) load(run, counter);
    for (bool waits = true; waits && !results_.stopped;) {
      waits = false;
      for (Run& run : runs_) {
        if (!run.is_settled && !results_.stopped) make(run, counter);
        waits |= !run.is_settled;
      }
      if (waits && !results_.stopped) wait();
    }
  }

  /// Takes over what an earlier or another process has made.
  void load(Run& run, RunCounter& counter) {
    if (run.is_settled) return;
    run.record = files_.load(run.planned);
    if (run.record) counter.skip();
    run.is_settled = run.record.has_value();
  }

  /// Makes a run, or learns how it has ended in another process. It stays unsettled as long as
  /// another process makes it, and if the work was stopped.
  void make(Run& run, RunCounter& counter) {
    const std::string name = run.planned.claim_name();
    load(run, counter);
    if (run.is_settled || place_.board().holder(name)) return;
    std::optional<FileLock> machine;
    if (is_timed_ && !(machine = lock_machine())) {
      results_.stopped = true;
      return;
    }
    if (const std::optional<Claim> claim = place_.board().try_claim(name)) {
      make_claimed(run, counter);
    }
  }

  void make_claimed(Run& run, RunCounter& counter) {
    run.record = files_.take_over(run.planned);
    if (run.record) {
      counter.skip();
    } else if (!files_.failure(run.planned)) {
      run.record = render(run.planned);
      if (run.record) counter.finish(*run.record);
    }
    const bool has_failed = !run.record && files_.failure(run.planned);
    if (has_failed) results_.failed.push_back(run.planned.name());
    run.is_settled = run.record || has_failed;
    results_.stopped |= !run.is_settled;
  }

  /// Keeps other processes from making runs on this machine meanwhile. Returns none if the work was
  /// stopped before.
  std::optional<FileLock> lock_machine() const {
    return FileLock::wait(machine_lock(), control_.render.stop);
  }

  /// Returns the order for a run.
  RunOrder order_of(const PlannedRun& run) const {
    return {.key = run.key,
            .scene = run.scene,
            .method = run.method,
            .seed = run.seed,
            .config = run.cell->text,
            .build = run.cell->build,
            .exposure = run.cell->exposure,
            .reference = fs::absolute(results_.references[run.cell->scene]->file),
            .stem = fs::absolute(files_.file(run, "")),
            .keeps_image = run.keeps_image,
            .keeps_pictures = run.seed == results_.config.first_seed};
  }

  /// Makes a run, in a process of its own if there is a program for it. Returns empty if the run
  /// was stopped or has failed.
  std::optional<RunRecord> render(const PlannedRun& run) {
    files_.clear(run);
    const RunOrder order = order_of(run);
    if (control_.run_program.empty()) return make_run(order, registry_, control_.render);
    const ChildEnd end =
        carry_out_in_child(order, files_.file(run, ".order"), results_.config.limits());
    // A run that had left its record before it was stopped counts.
    std::optional<RunRecord> record = end.problem.empty() ? files_.load(run) : std::nullopt;
    if (!record && !end.is_stopped) {
      const std::string reason = end.problem.empty() ? "it left no record" : end.problem;
      warn(fmt::format("{}: failed: {}", run.name(), reason));
      files_.save_failure(run, reason);
    }
    return record;
  }

  const Registry& registry_;
  const ExperimentControl& control_;
  Workplace place_;
  RunFiles files_;
  ExperimentResults results_;
  std::vector<Run> runs_;
  bool is_timed_ = false;  ///< the time of some runs counts, so none shares a machine
};

}  // namespace

const RunRecord* ExperimentResults::find(const std::string& scene, const std::string& method,
                                         std::uint64_t seed) const {
  for (const RunRecord& record : records) {
    if (record.scene == scene && record.method == method && record.seed == seed) return &record;
  }
  return nullptr;
}

ExperimentResults collect_results(const ExperimentConfig& config, ExperimentPlan plan,
                                  const std::function<void(const std::string&)>& on_warning) {
  ExperimentResults results{
      .config = config, .plan = std::move(plan), .references = {}, .failed = {}};
  for (const PlannedReference& planned : results.plan.references) {
    results.references.push_back(known_reference(planned, config.reference_cache(), on_warning));
  }
  const RunFiles files(config.output, on_warning);
  for (const PlannedRun& run : planned_runs(results.config, results.plan)) {
    ++results.run_count;
    if (!results.references[run.cell->scene]) continue;
    if (auto record = files.load(run)) results.records.push_back(std::move(*record));
    if (files.failure(run)) results.failed.push_back(run.name());
  }
  return results;
}

ExperimentResults run_experiment(const ExperimentConfig& config, ExperimentPlan plan,
                                 const Registry& registry, const ExperimentControl& control) {
  return Runner(config, std::move(plan), registry, control).run();
}

}  // namespace pharos
