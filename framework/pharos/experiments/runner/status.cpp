#include <algorithm>
#include <ctime>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include <pharos/experiments/runner/claims.h>
#include <pharos/experiments/runner/output_folder.h>
#include <pharos/experiments/runner/reference.h>
#include <pharos/experiments/runner/runs.h>
#include <pharos/experiments/runner/status.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

ExperimentStatus::Work work_of(const std::string& name, const Claimant& who) {
  const auto seconds = static_cast<double>(std::time(nullptr) - who.since);
  return {name, who.host, who.process, std::max(0.0, seconds)};
}

void add_reference_work(const ExperimentConfig& config, const ExperimentPlan& plan,
                        ExperimentStatus& status) {
  const fs::path folder = reference_claims(config.reference_cache());
  const ClaimBoard board(folder);
  for (std::size_t s = 0; s < plan.references.size(); ++s) {
    const PlannedReference& planned = plan.references[s];
    for (std::uint32_t part = 0; part < planned.parts; ++part) {
      const auto who = board.holder(part_claim(planned, part));
      if (!who) continue;
      status.references.push_back(
          work_of(fmt::format("{}, reference, part {}", config.scenes[s].name, part + 1), *who));
    }
  }
}

std::string time_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

ExperimentStatus experiment_status(const ExperimentConfig& config, const ExperimentPlan& plan) {
  ExperimentStatus status;
  const std::vector<PlannedRun> runs = planned_runs(config, plan);
  status.run_count = runs.size();
  if (!fs::is_directory(config.output)) return status;
  add_reference_work(config, plan, status);
  const ClaimBoard board(claims_folder(config.output));
  const RunFiles files(config.output, [](const std::string&) {});
  double seconds = 0;
  std::set<std::string> hosts;
  bool is_timed = false;
  for (const PlannedRun& run : runs) {
    is_timed |= run.is_timed;
    if (const auto record = files.peek(run)) {
      ++status.done;
      seconds += record->times.preparation + record->seconds();
    } else if (const auto who = board.holder(run.claim_name())) {
      status.running.push_back(work_of(run.name(), *who));
    } else if (const auto reason = files.failure(run)) {
      status.failed.push_back({run.name(), *reason});
    }
  }
  for (const std::string& worker : board.names(kWorkerClaims)) {
    const auto who = board.holder(worker);
    if (!who) continue;
    ++status.processes;
    hosts.insert(who->host);
  }
  const std::size_t left = status.run_count - status.done - status.failed.size();
  if (status.done > 0) {
    // Runs whose time counts do not share a machine.
    const std::size_t at_once =
        std::max<std::size_t>(1, is_timed ? hosts.size() : status.processes);
    status.seconds_left = seconds / static_cast<double>(status.done) * static_cast<double>(left) /
                          static_cast<double>(at_once);
  }
  return status;
}

std::string to_text(const ExperimentStatus& status) {
  const std::size_t left =
      status.run_count - status.done - status.running.size() - status.failed.size();
  std::string text =
      fmt::format("{} of {} runs done, {} running, {} failed, {} to do; {} process{} at work",
                  status.done, status.run_count, status.running.size(), status.failed.size(), left,
                  status.processes, status.processes == 1 ? "" : "es");
  if (status.seconds_left && status.processes > 0) {
    text += fmt::format("; about {} left", time_text(*status.seconds_left));
  }
  text += "\n";
  for (const auto* list : {&status.references, &status.running}) {
    for (const ExperimentStatus::Work& work : *list) {
      text += fmt::format("running  {}  on {} (process {}) for {}\n", work.name, work.host,
                          work.process, time_text(work.seconds));
    }
  }
  for (const ExperimentStatus::Failure& failure : status.failed) {
    text += fmt::format("failed   {}: {}\n", failure.run, failure.reason);
  }
  return text;
}

}  // namespace pharos
