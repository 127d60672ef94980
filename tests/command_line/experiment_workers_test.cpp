// Several processes that run one experiment in one folder.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/random.h>

#include "small_experiment.h"

namespace pharos::testing {
namespace {

namespace fs = std::filesystem;

/// Returns the rendered runs by their words, with how often each was rendered.
std::map<std::string, int> runs_in(const std::vector<Outcome>& outcomes) {
  std::map<std::string, int> runs;
  for (const Outcome& outcome : outcomes) {
    std::istringstream in(outcome.err);
    for (std::string line; std::getline(in, line);) {
      const std::size_t begin = line.find("] "), end = line.find(": relMSE");
      if (begin != line.npos && end != line.npos) ++runs[line.substr(begin, end - begin)];
    }
  }
  return runs;
}

/// Returns the process that has started `process`, a folder of /proc; 0 if it has ended.
int parent_of(const fs::path& process) {
  std::ifstream status(process / "status");
  for (std::string key, value; status >> key && std::getline(status, value);) {
    if (key == "PPid:") return std::stoi(value);
  }
  return 0;
}

/// Returns how many processes in `folder` have an argument that ends with `end`. Those that such a
/// process has started do not count: sanitizers copy a process to look into it.
std::size_t processes_with(const std::string& end, const fs::path& folder) {
  std::map<int, int> parents;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code error;
    if (fs::read_symlink(entry.path() / "cwd", error) != folder || error) continue;
    if (test::bytes_of(entry.path() / "cmdline").find(end + '\0') == std::string::npos) continue;
    parents[std::stoi(entry.path().filename().string())] = parent_of(entry.path());
  }
  return static_cast<std::size_t>(
      std::count_if(parents.begin(), parents.end(),
                    [&](const auto& process) { return !parents.contains(process.second); }));
}

TEST_CASE("three processes share the runs and references of an experiment") {
  constexpr int kSeeds = 6;
  const std::string table = undisturbed_table(kSeeds);
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", kSeeds);
  std::vector<std::future<Outcome>> workers;
  for (int i = 0; i < 3; ++i) {
    workers.push_back(std::async(
        std::launch::async, [&] { return run_pharos("experiment test.yaml", folder.path()); }));
  }
  std::vector<Outcome> outcomes;
  for (auto& worker : workers) outcomes.push_back(worker.get());
  std::size_t parts = 0;
  for (const Outcome& outcome : outcomes) {
    CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(rendered_runs(outcome) > 0);
    parts += rendered_parts(outcome);
  }
  CHECK(parts == 8);
  const std::map<std::string, int> runs = runs_in(outcomes);
  CHECK(runs.size() == 4 * kSeeds);
  for (const auto& run : runs) CHECK_MESSAGE(run.second == 1, run.first);
  CHECK(table_of(folder.path()) == table);
  CHECK(fs::is_empty(folder.path() / "test/claims"));
  CHECK(fs::is_empty(folder.path() / "cache/claims"));
}

TEST_CASE("what killed processes have begun is done by the one that lives") {
  constexpr int kSeeds = 8, kKills = 10;
  const std::string table = undisturbed_table(kSeeds);
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", kSeeds);
  const auto survivor = std::async(std::launch::async, [&] {
                          return run_pharos("experiment test.yaml", folder.path());
                        }).share();
  std::atomic<int> kills = 0;
  // Two more processes, each of which is started again after it was killed.
  const auto kill_again = [&, survivor](std::uint64_t seed) {
    RandomStream random(seed);
    while (survivor.wait_for(std::chrono::seconds(0)) != std::future_status::ready &&
           kills.fetch_add(1) < kKills) {
      const double seconds = 0.1 + 0.3 * static_cast<double>(random() >> 11) * 0x1p-53;
      interrupt_pharos("experiment test.yaml -q", folder.path(), seconds, "KILL");
    }
  };
  std::thread second(kill_again, 3), third(kill_again, 4);
  second.join();
  third.join();
  // On a fast machine the survivor may be done before.
  CHECK(kills >= 3);
  const Outcome outcome = survivor.get();
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(table_of(folder.path()) == table);
}

TEST_CASE("a run that has failed in one process is not tried by another") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 8", 4);
  const std::string module = fmt::format("PHAROS_MODULE_PATH={}/aborts", PHAROS_WRONG_MODULES);
  const std::string command =
      "experiment test.yaml --set 'methods.0.settings={ integrator: { type: abort } }'";
  std::vector<std::future<Outcome>> workers;
  for (int i = 0; i < 2; ++i) {
    workers.push_back(
        std::async(std::launch::async, [&] { return run_pharos(command, folder.path(), module); }));
  }
  std::size_t failures = 0;
  for (auto& worker : workers) {
    const Outcome outcome = worker.get();
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.err.find("8 failed: ") != std::string::npos);
    for (std::size_t at = 0; (at = outcome.err.find(": failed: ", at)) != std::string::npos; ++at) {
      ++failures;
    }
  }
  CHECK(failures == 8);
  const Outcome status = run_pharos(command + " --status", folder.path(), module);
  CHECK(status.out.find("8 of 16 runs done, 0 running, 8 failed, 0 to do; 0 processes at work") !=
        std::string::npos);
  CHECK(status.out.find("failed   deep, independent, seed 1: ended by signal 6") !=
        std::string::npos);
}

TEST_CASE("runs with a time budget take turns on a machine") {
  const ScratchFolder folder;
  write_experiment(folder, "seconds: 0.3", 2);
  std::vector<std::future<Outcome>> workers;
  for (int i = 0; i < 3; ++i) {
    workers.push_back(std::async(
        std::launch::async, [&] { return run_pharos("experiment test.yaml", folder.path()); }));
  }
  std::vector<Outcome> outcomes;
  // A process that makes a run or a part of a reference has its order as an argument.
  std::size_t most = 0, looks = 0;
  const auto is_at_work = [](std::future<Outcome>& worker) {
    return worker.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready;
  };
  while (std::any_of(workers.begin(), workers.end(), is_at_work)) {
    const std::size_t orders = processes_with(".order", fs::canonical(folder.path()));
    most = std::max(most, orders);
    looks += orders > 0 ? 1 : 0;
  }
  for (auto& worker : workers) outcomes.push_back(worker.get());
  CHECK(runs_in(outcomes).size() == 8);
  CHECK(looks > 10);
  CHECK(most == 1);
}

TEST_CASE("--status lists runs that are done or running, --report writes the runs that are done") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", 10000);
  CHECK(
      run_pharos("experiment test.yaml --status", folder.path())
          .out.starts_with("0 of 40000 runs done, 0 running, 0 failed, 40000 to do; 0 processes"));
  CHECK_FALSE(folder.has("test"));
  CHECK(run_pharos("experiment test.yaml --report", folder.path()).exit_code == 2);
  auto busy = std::async(std::launch::async, [&] {
    return interrupt_pharos_once("done", "experiment test.yaml -q", folder.path(), "INT");
  });
  CHECK(appears(folder.path() / "test/runs/deep/independent/seed-2.json"));
  // Between two runs, none is running.
  Outcome status;
  for (int look = 0; look < 20 && status.out.find("\nrunning  ") == std::string::npos; ++look) {
    status = run_pharos("experiment test.yaml --status", folder.path());
  }
  const Outcome report = run_pharos("experiment test.yaml --report", folder.path());
  CHECK_MESSAGE(report.exit_code == 0, report.err);
  CHECK(folder.has("test/report.html"));
  CHECK(test::bytes_of(folder.path() / "test/results.json").find("\"complete\": false") !=
        std::string::npos);
  folder.write("done", "");
  CHECK(busy.get().exit_code == 130);
  CHECK(status.exit_code == 0);
  CHECK(status.out.find("; 1 process at work; about ") != std::string::npos);
  CHECK(status.out.find("\nrunning  ") != std::string::npos);
}

}  // namespace
}  // namespace pharos::testing
