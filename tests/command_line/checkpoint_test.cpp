// Checkpoints from the command line: kills, signals, full disks, and files that do not fit.

#include <chrono>
#include <fstream>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>
#include <pharos/core/random.h>

#include "box_outputs.h"
#include "process.h"
#include "refusal.h"

namespace pharos::testing {
namespace {

namespace fs = std::filesystem;

void write_content(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Writes the config of a guided render that leaves a checkpoint every `every` seconds. It takes
/// about a second for each 64 samples.
void write_config(const ScratchFolder& folder, const std::string& integrator, int spp,
                  double every) {
  folder.write("box.yaml",
               fmt::format("scene: {}/cornell-box/scene.yaml\n"
                           "film: {{ width: 96, height: 64 }}\nbudget: {{ spp: {} }}\n"
                           "output: {{ checkpoint: box.checkpoint, every: {}, model: box.model }}\n"
                           "integrator: {}\n",
                           PHAROS_SCENES, spp, every, integrator));
}

constexpr const char* kGuided = "{ type: path, guiding: pavmm }";

/// Leaves out the many checkpoints that a test needs only before an interruption.
constexpr const char* kFewCheckpoints = " --set output.every=300";

/// Renders the config of another folder without interruption.
BoxOutputs undisturbed(const ScratchFolder& other) {
  const ScratchFolder folder;
  fs::copy_file(other.path() / "box.yaml", folder.path() / "box.yaml");
  const Outcome outcome =
      run_pharos(std::string("render box.yaml -q") + kFewCheckpoints, folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  return box_outputs_in(folder);
}

/// Goes on until the render is done, and compares.
void check_ends_like(const ScratchFolder& folder, const BoxOutputs& whole) {
  const Outcome outcome =
      run_pharos(std::string("render box.yaml -q --resume") + kFewCheckpoints, folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  const bool same = box_outputs_in(folder) == whole;
  CHECK(same);
}

TEST_CASE("a killed render goes on to the same bits") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 128, 0.02);
  const BoxOutputs whole = undisturbed(folder);
  interrupt_pharos_once("box.checkpoint", "render box.yaml -q", folder.path(), "KILL");
  for (int kills = 0; kills < 2; ++kills) {
    interrupt_pharos("render box.yaml -q --resume", folder.path(), 0.4, "KILL");
  }
  CHECK(folder.has("box.checkpoint"));
  check_ends_like(folder, whole);
  CHECK(folder.file_count() == 5);  // nothing temporary is left
}

TEST_CASE("signals that ask a render to end leave a checkpoint") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 128, 1e9);
  const BoxOutputs whole = undisturbed(folder);
  for (const char* signal : {"INT", "TERM", "HUP", "USR2"}) {
    CAPTURE(signal);
    fs::remove(folder.path() / "box.checkpoint");
    const Outcome outcome =
        interrupt_pharos("render box.yaml --set budget.spp=128", folder.path(), 0.6, signal);
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.err.find("box.checkpoint: --resume goes on") != std::string::npos);
  }
  check_ends_like(folder, whole);
  // What a limit on the processor time sends.
  fs::remove(folder.path() / "box.checkpoint");
  const Outcome outcome =
      run_pharos("render box.yaml --set budget.spp=1000000", folder.path(), "ulimit -S -t 2;");
  CHECK(outcome.exit_code == 130);
  CHECK(outcome.err.find("box.checkpoint: --resume goes on") != std::string::npos);
}

TEST_CASE("SIGUSR1 asks for a checkpoint, and ends a render that has none") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 100000, 1e9);
  const std::string asks = "sleep 0.5 && kill -USR1 $! && sleep 0.3 && [ -e box.checkpoint ]";
  CHECK(interrupt_pharos_when(asks, "render box.yaml -q", folder.path(), "KILL").exit_code == 137);
  CHECK(folder.has("box.checkpoint"));
  fs::remove(folder.path() / "box.checkpoint");
  CHECK(interrupt_pharos("render box.yaml -q --set 'output.checkpoint=\"\"'", folder.path(), 0.6,
                         "USR1")
            .exit_code == 130);
  CHECK(folder.has("box.exr"));
}

TEST_CASE("--resume without a checkpoint starts anew and says so") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 4, 1e9);
  const Outcome outcome = run_pharos("render box.yaml --resume", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("box.checkpoint: there is no such checkpoint yet") != std::string::npos);
}

TEST_CASE("a finished image gets more samples") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 8, 1e9);
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  const Image first = read_image(folder.path() / "box.exr");
  fs::rename(folder.path() / "box.exr", folder.path() / "kept.exr");
  const Outcome outcome =
      run_pharos("render box.yaml --continue kept.exr --set budget.spp=64", folder.path());
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(outcome.err.find("kept.exr: 96 x 64, 64 samples a pixel") != std::string::npos);
  CHECK(read_image(folder.path() / "kept.exr").values() != first.values());
  // Once more, from the new checkpoint.
  CHECK(run_pharos("render box.yaml --continue kept.exr --set budget.spp=70", folder.path())
            .exit_code == 0);
}

TEST_CASE("a render that adds samples and was killed goes on with --resume") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 8, 1e9);
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  fs::copy_file(folder.path() / "box.checkpoint", folder.path() / "finished");
  const std::string more = "render box.yaml -q -o box.exr --set budget.spp=512 ";
  interrupt_pharos_when("! cmp -s box.checkpoint finished", more + "--continue box.exr",
                        folder.path(), "KILL");
  CHECK(run_pharos(more + "--resume", folder.path()).exit_code == 0);
  CHECK(read_metadata(folder.path() / "box.exr").at("pharos:samples_per_pixel") == "512");
}

TEST_CASE("checkpoints that do not fit are refused") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 8, 1e9);
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  const std::string sound = test::bytes_of(folder.path() / "box.checkpoint");
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& says,
                           const std::string& checkpoint) {
    check_refused({.arguments = "render box.yaml " + arguments,
                   .prepare =
                       [&](const ScratchFolder& own) {
                         for (const char* name : {"box.yaml", "box.exr"}) {
                           fs::copy_file(folder.path() / name, own.path() / name);
                         }
                         if (!checkpoint.empty()) {
                           write_content(own.path() / "box.checkpoint", checkpoint);
                         }
                       }},
                  says);
  };
  refused("--resume --set budget.spp=16",
          {"'box.checkpoint' belongs to another config", "'budget.spp'", "'8'", "'16'"}, sound);
  refused("--resume --set film.tile=8", {"another config", "'film.tile'"}, sound);
  refused("--resume --set 'output.checkpoint=\"\"'", {"--resume", "output.checkpoint"}, sound);
  refused("--resume", {"'box.checkpoint' exists and is no checkpoint"}, "Some text");
  refused("--resume", {"'box.checkpoint' is cut off"}, sound.substr(0, sound.size() / 2));
  std::string damaged = sound;
  damaged[damaged.size() / 2] ^= 4;
  refused("--resume", {"'box.checkpoint' is damaged"}, damaged);
  refused("--continue box.exr", {"--continue", "budget.spp above 8, found 8"}, sound);
  refused("--continue box.exr --set 'budget={ seconds: 5 }'", {"of the same kind"}, sound);
  refused("--continue box.exr --set budget.spp=16 --set seed=2", {"another config", "seed"}, sound);
  refused("--continue none.exr --set budget.spp=16", {"none.exr"}, sound);
  refused("--continue box.exr --set budget.spp=16", {"the checkpoint 'box.checkpoint'"}, "");
  refused("--continue box.exr --resume", {"--resume"}, sound);

  REQUIRE(run_pharos("render box.yaml -q --set seed=5 -o other.exr", folder.path()).exit_code == 0);
  refused("--continue box.exr --set budget.spp=16 --set seed=5",
          {"box.exr: error: this is not the image of the checkpoint"},
          test::bytes_of(folder.path() / "box.checkpoint"));
  interrupt_pharos("render box.yaml -q --set budget.spp=100000", folder.path(), 0.5, "INT");
  refused("--continue box.exr --set budget.spp=200000",
          {"not finished", "--resume -o box.exr --set budget.spp=100000"},
          test::bytes_of(folder.path() / "box.checkpoint"));
  refused("--set output.checkpoint=none/box.checkpoint", {"'none' does not exist"}, sound);
}

/// Returns a checkpoint with another number in the form, or another version of Pharos.
std::string with_form(std::string checkpoint, char form) {
  checkpoint[8] = form;
  return checkpoint;
}

TEST_CASE("checkpoints of other forms, files and renders are refused or replaced with a warning") {
  const ScratchFolder folder;
  write_config(folder, "path", 4, 1e9);
  folder.write("notes.txt", "Some text");
  folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string mesh =
      "render box.yaml --set 'scene={ sensor: perspective, shapes: [{ type: "
      "mesh, file: quad.obj }] }' --resume";
  REQUIRE(run_pharos(mesh, folder.path()).exit_code == 0);
  const std::string sound = test::bytes_of(folder.path() / "box.checkpoint");
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = run_pharos(arguments, folder.path());
    CHECK(outcome.exit_code == 2);
    CHECK_FALSE(folder.has("box.checkpoint.pharos-lock"));
    return outcome.err;
  };
  folder.write("quad.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  CHECK(refusal(mesh).find("the file that 'scene.shapes.0.file' names has changed since then") !=
        std::string::npos);
  CHECK(refusal("render box.yaml --set output.checkpoint=notes.txt")
            .find("is no checkpoint of Pharos, so it is not") != std::string::npos);
  CHECK(test::bytes_of(folder.path() / "notes.txt") == "Some text");
  write_content(folder.path() / "box.checkpoint", with_form(sound, 1));
  CHECK(refusal("render box.yaml --resume").find("is of form 1; this Pharos reads form 2") !=
        std::string::npos);
  const Outcome replaced = run_pharos("render box.yaml", folder.path());
  CHECK(replaced.exit_code == 0);
  CHECK(replaced.err.find("warning: box.checkpoint: will be replaced") != std::string::npos);
  CHECK(replaced.err.find("box.model: not written") != std::string::npos);
}

TEST_CASE("two renders never write the same checkpoint") {
  const ScratchFolder folder;
  write_config(folder, "path", 1000000, 0.02);
  const std::string other = fmt::format(
      "timeout 60 {} render box.yaml -o other.exr 2>refusal; [ $? = 2 ]", PHAROS_PROGRAM);
  CHECK(interrupt_pharos_when("[ -e box.checkpoint ] && " + other, "render box.yaml -q",
                              folder.path(), "INT")
            .exit_code == 130);
  CHECK(test::bytes_of(folder.path() / "refusal").find("is being written by another render") !=
        std::string::npos);
  CHECK_FALSE(folder.has("box.checkpoint.pharos-lock"));
}

TEST_CASE("if the disk is full, the last checkpoint stays, and the image is written") {
  const ScratchFolder folder;
  write_config(folder, kGuided, 64, 0.02);
  REQUIRE(run_pharos("render box.yaml -q --set budget.spp=1", folder.path()).exit_code == 0);
  const std::string old = test::bytes_of(folder.path() / "box.checkpoint");
  // Files end after 350 kB: the image is smaller, a checkpoint is larger.
  const Outcome outcome = run_pharos("render box.yaml", folder.path(), "ulimit -f 700;");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.find("warning: no checkpoint: cannot write") != std::string::npos);
  const bool is_old = test::bytes_of(folder.path() / "box.checkpoint") == old;
  CHECK(is_old);
  CHECK(folder.has("box.exr"));
  CHECK(folder.file_count() == 5);  // without the lock
}

/// Renders of the soak test. One takes about two seconds.
constexpr const char* kSoaked[] = {
    "{ type: path, guiding: focal }",
    "{ type: path, guiding: spatial-gaussians }",
    "{ type: bidirectional, light_paths: training, guiding: { learner: { type: vertex_triplets, "
    "light_paths: true }, guider: vertex_triplets, training: { schedule: geometric } } }",
    "{ type: path, guiding: robust }",
};

double seconds_of(const ScratchFolder& folder) {
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST_CASE("soak: killed at random moments, renders of four methods go on to the same bits") {
  RandomStream random(7);
  int equal = 0;
  for (const char* integrator : kSoaked) {
    CAPTURE(integrator);
    const ScratchFolder folder;
    write_config(folder, integrator, 128, 0.05);
    const double seconds = seconds_of(folder);
    const BoxOutputs whole = box_outputs_in(folder);
    for (int kill = 0; kill < 25; ++kill) {
      for (const char* file : {"box.checkpoint", "box.exr", "box.model"}) {
        fs::remove(folder.path() / file);
      }
      interrupt_pharos("render box.yaml -q", folder.path(), random.next_1d() * seconds, "KILL");
      check_ends_like(folder, whole);
      equal += box_outputs_in(folder) == whole ? 1 : 0;
    }
  }
  CHECK(equal == 100);
}

TEST_CASE("soak: killed while a checkpoint is written, a render goes on to the same bits") {
  const ScratchFolder folder;
  write_config(folder, kSoaked[3], 128, 1e-3);
  const BoxOutputs whole = undisturbed(folder);
  int kills_in_writing = 0;
  for (int kill = 0; kill < 20; ++kill) {
    fs::remove(folder.path() / "box.checkpoint");
    // The first checkpoint is there, and another one is being written.
    interrupt_pharos_when("[ -e box.checkpoint ] && ls box.checkpoint.*.tmp", "render box.yaml -q",
                          folder.path(), "KILL");
    kills_in_writing += folder.file_count() > 6 ? 1 : 0;  // the lock and the temporary file
    check_ends_like(folder, whole);
  }
  CHECK(kills_in_writing >= 15);
}

}  // namespace
}  // namespace pharos::testing
