// Renders on several processes that mpirun starts. tests/integration has what does not need MPI.

#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "box_outputs.h"
#include "process.h"

namespace pharos::testing {
namespace {

namespace fs = std::filesystem;

void write_config(const ScratchFolder& folder, const std::string& preset, int spp,
                  double every = 300) {
  folder.write("box.yaml",
               fmt::format("scene: {}/cornell-box/scene.yaml\n"
                           "film: {{ width: 96, height: 64, tile: 16 }}\nbudget: {{ spp: {} }}\n"
                           "output: {{ checkpoint: box.checkpoint, every: {}, model: box.model }}\n"
                           "integrator: {{ type: path, guiding: {} }}\n",
                           PHAROS_SCENES, spp, every, preset));
}

/// Goes on to the end, without the many checkpoints that a test needs before.
constexpr const char* kResume = "render box.yaml -q --resume --set output.every=300";

BoxOutputs outputs_alone(const std::string& preset, int spp) {
  const ScratchFolder folder;
  write_config(folder, preset, spp);
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  return box_outputs_in(folder);
}

TEST_CASE("mpirun: two ranks render the same image and learn the same model as one process") {
  for (const char* preset : {"pavmm", "robust"}) {
    CAPTURE(preset);
    const ScratchFolder folder;
    write_config(folder, preset, 64);
    const Outcome outcome = run_on_ranks(2, "render box.yaml", folder.path());
    CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
    // Rank 0 alone reports the result.
    const std::string report = "box.exr: 96 x 64, 64 samples a pixel";
    CHECK(outcome.err.find(report) != std::string::npos);
    CHECK(outcome.err.find(report) == outcome.err.rfind(report));
    const bool same = box_outputs_in(folder) == outputs_alone(preset, 64);
    CHECK(same);
  }
}

TEST_CASE("mpirun: bad input gives one message") {
  const ScratchFolder folder;
  folder.write("bad.yaml", "scene: nowhere.yaml\n");
  const Outcome outcome = run_on_ranks(3, "render bad.yaml", folder.path());
  CHECK(outcome.exit_code == 2);
  const std::size_t first = outcome.err.find("bad.yaml:1:");
  CHECK(first != std::string::npos);
  CHECK(outcome.err.find("bad.yaml:1:", first + 1) == std::string::npos);

  write_config(folder, "pavmm", 16);
  const Outcome replay = run_on_ranks(2, "render box.yaml --replay 1,1,0", folder.path());
  CHECK(replay.exit_code == 2);
  CHECK(replay.err.find("--replay: error: one process traces the path") != std::string::npos);
}

/// Returns the process that is `rank` of a program in `folder`; 0: there is none.
pid_t process_of(int rank, const fs::path& folder) {
  const std::string wanted = fmt::format("OMPI_COMM_WORLD_RANK={}", rank);
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code error;
    if (fs::read_symlink(entry.path() / "cwd", error) != folder || error) continue;
    const std::string environment = test::bytes_of(entry.path() / "environ");
    if (environment.find(wanted + '\0') != std::string::npos) {
      return std::stoi(entry.path().filename().string());
    }
  }
  return 0;
}

TEST_CASE("mpirun: a killed rank ends the job, and its checkpoint goes on with other ranks") {
  const BoxOutputs whole = outputs_alone("pavmm", 128);
  for (const int killed : {0, 1}) {
    CAPTURE(killed);
    const ScratchFolder folder;
    write_config(folder, "pavmm", 128, 0.02);
    Outcome outcome;
    std::jthread job([&] { outcome = run_on_ranks(2, "render box.yaml -q", folder.path()); });
    REQUIRE(appears(folder.path() / "box.checkpoint"));
    const pid_t process = process_of(killed, fs::canonical(folder.path()));
    if (process > 0) kill(process, SIGKILL);
    job.join();
    REQUIRE(process > 0);
    CHECK(outcome.exit_code != 0);
    CHECK_MESSAGE(outcome.err.find("signal 9") != std::string::npos, outcome.err);
    const int ranks = killed == 0 ? 3 : 1;
    const Outcome rest = run_on_ranks(ranks, kResume, folder.path());
    CHECK_MESSAGE(rest.exit_code == 0, rest.err);
    const bool same = box_outputs_in(folder) == whole;
    CHECK(same);
  }
}

/// Returns the process of mpirun in `folder`; 0: there is none.
pid_t starter_in(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code error;
    if (fs::read_symlink(entry.path() / "cwd", error) != folder || error) continue;
    if (test::bytes_of(entry.path() / "comm").starts_with("mpi")) {
      return std::stoi(entry.path().filename().string());
    }
  }
  return 0;
}

TEST_CASE("mpirun: SIGUSR2 ends a render, which goes on from there") {
  const BoxOutputs whole = outputs_alone("pavmm", 128);
  const ScratchFolder folder;
  write_config(folder, "pavmm", 128, 0.02);
  Outcome outcome;
  std::jthread job([&] { outcome = run_on_ranks(2, "render box.yaml", folder.path()); });
  CHECK(appears(folder.path() / "box.checkpoint"));
  const pid_t process = starter_in(fs::canonical(folder.path()));
  if (process > 0) kill(process, SIGUSR2);
  job.join();
  REQUIRE(process > 0);
  CHECK_MESSAGE(outcome.exit_code == 130, outcome.err);
  CHECK(folder.has("box.exr"));
  CHECK(outcome.err.find("--resume goes on from here") != std::string::npos);
  const Outcome rest = run_on_ranks(2, kResume, folder.path());
  CHECK_MESSAGE(rest.exit_code == 0, rest.err);
  const bool same = box_outputs_in(folder) == whole;
  CHECK(same);
}

}  // namespace
}  // namespace pharos::testing
