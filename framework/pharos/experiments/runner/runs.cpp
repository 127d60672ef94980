#include <fstream>

#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/experiments/runner/content_key.h>
#include <pharos/experiments/runner/machine.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/runs.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFailure = ".failed";

std::string machine_type() {
  return fmt::format("{} {}", thread_count(), processor_name());
}

/// Returns the key of a run. The result of a run with a time budget also depends on the machine.
std::string key_of(const PlannedRun& run, const std::string& reference) {
  std::string key = fmt::format("{} {} {}", run.cell->key, reference, run.seed);
  if (run.is_timed) key += " " + machine_type();
  return content_key(key);
}

}  // namespace

std::string PlannedRun::name() const {
  return fmt::format("{}, {}, seed {}", scene, method, seed);
}

std::string PlannedRun::claim_name() const {
  return fmt::format("{}@{}@{}", scene, method, seed);
}

std::vector<PlannedRun> planned_runs(const ExperimentConfig& config, const ExperimentPlan& plan) {
  std::vector<PlannedRun> runs;
  const std::uint64_t first = config.first_seed;
  for (std::uint64_t seed = first; seed < first + config.seeds; ++seed) {
    for (const PlannedCell& cell : plan.cells) {
      const ExperimentScene& scene = config.scenes[cell.scene];
      const ExperimentMethod& method = config.methods[cell.method];
      if (seed >= first + config.seeds_of(method)) continue;
      PlannedRun& run = runs.emplace_back(
          PlannedRun{.cell = &cell, .seed = seed, .scene = scene.name, .method = method.name});
      run.is_timed = config.budget_of(scene, method).seconds.has_value();
      run.keeps_image = seed == first || config.images == KeptImages::all;
      run.key = key_of(run, plan.references[cell.scene].key);
    }
  }
  return runs;
}

std::string plan_key(const ExperimentConfig& config, const ExperimentPlan& plan) {
  std::string all;
  bool is_timed = false;
  for (const PlannedReference& reference : plan.references) all += reference.key + " ";
  for (const PlannedCell& cell : plan.cells) {
    all += cell.key + " ";
    is_timed |= config.budget_of(config.scenes[cell.scene], config.methods[cell.method])
                    .seconds.has_value();
  }
  return content_key(all + (is_timed ? machine_type() : ""));
}

fs::path run_file(const fs::path& folder, const std::string& scene, const std::string& method,
                  std::uint64_t seed, const std::string& extension) {
  return folder / "runs" / scene / method / fmt::format("seed-{}{}", seed, extension);
}

RunFiles::Remains RunFiles::examine(const PlannedRun& run) const {
  std::optional<RunRecord> record;
  try {
    record = load_record(file(run, ".json"));
  } catch (const InputError& error) {
    return {{}, error.what(), true};
  }
  if (!record || record->key != run.key) return {};
  if (run.keeps_image && !record->files.contains(".exr")) return {};
  for (const auto& [extension, key] : record->files) {
    const fs::path kept = file(run, extension);
    if (access_problem(kept).empty() && content_key_of_file(kept) == key) continue;
    return {{}, fmt::format("{}: missing or changed, so the run is made again", kept.string())};
  }
  return {std::move(record)};
}

std::optional<RunRecord> RunFiles::load(const PlannedRun& run) const {
  return examine(run).record;
}

std::optional<RunRecord> RunFiles::take_over(const PlannedRun& run) const {
  // Network file systems remember for a while that a file did not exist, unless its folder is read.
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(file(run, "").parent_path(), none)) {
    if (entry.path() == file(run, ".json")) break;
  }
  Remains remains = examine(run);
  if (remains.is_damaged) remains.problem += ": " + moved_aside(file(run, ".json"));
  if (!remains.problem.empty()) warn_(remains.problem);
  return std::move(remains.record);
}

std::optional<RunRecord> RunFiles::peek(const PlannedRun& run) const {
  try {
    std::optional<RunRecord> record = load_record(file(run, ".json"));
    if (record && record->key == run.key) return record;
  } catch (const InputError&) {  // it will be made again
  }
  return std::nullopt;
}

void RunFiles::clear(const PlannedRun& run) const {
  remove_run(file(run, ""));
}

void RunFiles::save_failure(const PlannedRun& run, const std::string& reason) const {
  fs::create_directories(file(run, "").parent_path());
  write_text_atomically(file(run, kFailure), reason + "\n");
}

std::optional<std::string> RunFiles::failure(const PlannedRun& run) const {
  std::ifstream in(file(run, kFailure));
  std::string reason;
  if (!std::getline(in, reason)) return std::nullopt;
  return reason;
}

void RunFiles::forget_failure(const PlannedRun& run) const {
  fs::remove(file(run, kFailure));
}

}  // namespace pharos
