// `pharos experiment` after damage, failed runs, Ctrl-C and kills.

#include <filesystem>
#include <fstream>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>
#include <pharos/core/random.h>

#include "small_experiment.h"

namespace pharos::testing {
namespace {

namespace fs = std::filesystem;

TEST_CASE("damaged or edited files of an experiment are made again") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 8", 1);
  REQUIRE(run_pharos("experiment test.yaml", folder.path()).exit_code == 0);
  const std::string table = table_of(folder.path());
  const fs::path runs = folder.path() / "test/runs/deep/sobol";
  const auto again = [&](std::size_t expected, const std::string& says) {
    const Outcome outcome = run_pharos("experiment test.yaml", folder.path());
    CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
    CHECK(rendered_runs(outcome) == expected);
    CHECK_MESSAGE(outcome.err.find(says) != std::string::npos, outcome.err);
    CHECK(table_of(folder.path()) == table);
  };
  const auto change = [&](const fs::path& file, const std::string& from, const std::string& to) {
    std::string text = test::bytes_of(file);
    text.replace(text.find(from), from.size(), to);
    std::ofstream(file, std::ios::binary) << text;
  };
  const auto references = [&] {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder.path() / "cache")) {
      if (entry.path().extension() == ".exr") files.push_back(entry.path());
    }
    return files;
  };
  // An edited number in a record.
  change(runs / "seed-1.json", "\"mse\": 0.", "\"mse\": 1.");
  again(1, "seed-1.json: error: the record is damaged or was changed: moved to '");
  CHECK(folder.has("test/runs/deep/sobol/seed-1.json.damaged"));
  // A record that is cut off.
  fs::resize_file(runs / "seed-1.json", 100);
  again(1, "the record is damaged");
  // A folder in place of a record.
  fs::remove(runs / "seed-1.json");
  fs::create_directory(runs / "seed-1.json");
  again(1, "found a folder: moved to '");
  // An image that is no image.
  std::ofstream(runs / "seed-1.exr") << "garbage";
  again(1, "seed-1.exr: missing or changed");
  // References that are cut off.
  for (const fs::path& file : references()) fs::resize_file(file, 1000);
  again(0, ".exr.damaged', and is rendered again");
  // References with one other pixel.
  for (const fs::path& file : references()) {
    Image image = read_image(file);
    image.values()[7] *= 2;
    write_exr(image, file, read_metadata(file));
  }
  again(0, ".exr: its pixels were changed; moved to '");
}

TEST_CASE("a run that aborts or takes too long ends nothing but itself") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 8", 2);
  const std::string module = fmt::format("PHAROS_MODULE_PATH={}/aborts", PHAROS_WRONG_MODULES);
  const Outcome outcome =
      run_pharos("experiment test.yaml --set 'methods.0.settings={ integrator: { type: abort } }'",
                 folder.path(), module);
  CHECK(outcome.exit_code == 3);
  CHECK(rendered_runs(outcome) == 4);
  CHECK_MESSAGE(
      outcome.err.find("deep, independent, seed 1: failed: ended by signal 6") != std::string::npos,
      outcome.err);
  CHECK(outcome.err.find("4 failed: 'deep, independent, seed 1'") != std::string::npos);
  CHECK(folder.has("test/report.html"));
  CHECK(folder.has("test/runs/flat/sobol/seed-2.json"));
  // The same experiment without the mistake makes the missing runs.
  CHECK(rendered_runs(run_pharos("experiment test.yaml", folder.path())) == 4);

  const Outcome late =
      run_pharos("experiment test.yaml --set budget.spp=1000000 --set time_limit=0.5 --set seeds=1",
                 folder.path());
  CHECK(late.exit_code == 3);
  CHECK(late.err.find("failed: took longer than 0.5 s") != std::string::npos);
}

TEST_CASE("a reference that aborts ends nothing but the runs of its scene") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 8", 2);
  const std::string module = fmt::format("PHAROS_MODULE_PATH={}/aborts", PHAROS_WRONG_MODULES);
  const Outcome outcome = run_pharos(
      "experiment test.yaml --set 'scenes.0.reference={ spp: 4, parts: 2, settings: { "
      "integrator: { type: abort } } }'",
      folder.path(), module);
  CHECK(outcome.exit_code == 3);
  CHECK_MESSAGE(outcome.err.find("deep: the reference failed, so the scene has no runs: ended by "
                                 "signal 6") != std::string::npos,
                outcome.err);
  CHECK(outcome.err.find("'deep, reference'") != std::string::npos);
  CHECK(rendered_runs(outcome) == 4);
  CHECK(folder.has("test/report.html"));
  CHECK_FALSE(folder.has("test/reference.order"));
  CHECK(rendered_runs(run_pharos("experiment test.yaml", folder.path())) == 4);
}

TEST_CASE("Ctrl-C keeps finished runs and reports them; the same command goes on") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", 200);
  const Outcome outcome = interrupt_pharos_once("test/runs/deep/independent/seed-1.json",
                                                "experiment test.yaml", folder.path(), "INT");
  CHECK(outcome.exit_code == 130);
  REQUIRE(folder.has("test/results.json"));
  CHECK(test::bytes_of(folder.path() / "test/results.json").find("\"complete\": false") !=
        std::string::npos);
  CHECK(folder.has("test/report.html"));
  const Outcome rest = run_pharos("experiment test.yaml --set seeds=2", folder.path());
  CHECK(rest.exit_code == 0);
  CHECK(table_of(folder.path()) == undisturbed_table(2));

  // Results of methods that did not change are kept, even if the next run is stopped early.
  interrupt_pharos(
      "experiment test.yaml --set seeds=2 --set methods.1.settings={} --set "
      "budget.spp=16 --set scenes.1.reference.spp=1000000",
      folder.path(), 1.5, "INT");
  const std::string kept = table_of(folder.path());
  CHECK(kept.find("deep,independent,1,") != std::string::npos);
  CHECK(kept.find("deep,independent,2,") != std::string::npos);
}

/// Starts an experiment and kills it after `seconds`. Repeats this with `more` additional seconds
/// each time, until the experiment ends by itself. Returns the number of kills.
int run_with_kills(const ScratchFolder& folder, double seconds, double more) {
  for (int kills = 0;; ++kills) {
    const Outcome outcome =
        interrupt_pharos("experiment test.yaml", folder.path(), seconds + kills * more, "KILL");
    if (outcome.exit_code == 0) return kills;
  }
}

TEST_CASE("all signals that end a job stop an experiment, which goes on later") {
  for (const std::string signal : {"TERM", "HUP", "USR1", "USR2"}) {
    CAPTURE(signal);
    const ScratchFolder folder;
    write_experiment(folder, "spp: 16", 500);
    const Outcome outcome =
        interrupt_pharos_once("test/runs/deep/independent/seed-1.json", "experiment test.yaml",
                              folder.path(), signal.c_str());
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.err.find(" failed: ") == std::string::npos);
    CHECK(folder.has("test/report.html"));
  }
}

TEST_CASE("a run that a signal ends after its record was written counts") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", 500);
  const std::string module = fmt::format("PHAROS_MODULE_PATH={}/lingers", PHAROS_WRONG_MODULES);
  const Outcome outcome =
      interrupt_pharos_once("test/runs/deep/independent/seed-1.json", "experiment test.yaml",
                            folder.path(), "TERM", module);
  CHECK(outcome.exit_code == 130);
  CHECK(rendered_runs(outcome) == 1);
  CHECK(folder.has("test/report.html"));
}

TEST_CASE("an experiment that is killed and started again gives the same table") {
  const std::string table = undisturbed_table(4);
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", 4);
  CHECK(run_with_kills(folder, 0.1, 0.1) > 0);
  CHECK(table_of(folder.path()) == table);
}

TEST_CASE("long: killed at random moments, an experiment gives the same table, 20 of 20") {
  const std::string table = undisturbed_table(8);
  RandomStream random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const ScratchFolder folder;
    write_experiment(folder, "spp: 16", 8);
    const double first = 0.02 + 0.4 * static_cast<double>(random() >> 11) * 0x1p-53;
    CHECK(run_with_kills(folder, first, 0.05) > 0);
    CHECK_MESSAGE(table_of(folder.path()) == table, "trial ", trial);
  }
}

}  // namespace
}  // namespace pharos::testing
