// `pharos experiment` from the command line: what it leaves and what it renders again.

#include <filesystem>
#include <future>
#include <sstream>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "small_experiment.h"

namespace pharos::testing {
namespace {

namespace fs = std::filesystem;

TEST_CASE("an experiment leaves tables, images, records and a report") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", 2);
  const Outcome outcome = run_pharos("experiment test.yaml", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  CHECK(rendered_runs(outcome) == 8);
  for (const char* file : {"test/results.json", "test/runs.csv", "test/measures.csv",
                           "test/convergence.csv", "test/report.html",
                           "test/runs/flat/sobol/seed-1.exr", "test/runs/flat/sobol/seed-2.json"}) {
    CHECK_MESSAGE(folder.has(file), file);
  }
  CHECK_FALSE(folder.has("test/runs/flat/sobol/seed-2.exr"));  // images: first
  CHECK(test::bytes_of(folder.path() / "test/convergence.csv").find("deep,sobol,2,8,") !=
        std::string::npos);

  SUBCASE("again, it renders nothing and says the same") {
    const std::string table = table_of(folder.path());
    const Outcome again = run_pharos("experiment test.yaml", folder.path());
    CHECK(again.exit_code == 0);
    CHECK(rendered_runs(again) == 0);
    CHECK(table_of(folder.path()) == table);
  }
  SUBCASE("what changes is rendered again, the rest and the references are not") {
    const Outcome changed = run_pharos(
        "experiment test.yaml --set methods.1.settings.integrator.max_depth=3", folder.path());
    CHECK(changed.exit_code == 0);
    CHECK(rendered_runs(changed) == 4);
    CHECK(changed.err.find("reference, part") == std::string::npos);
    const Outcome more = run_pharos(
        "experiment test.yaml --set methods.1.settings.integrator.max_depth=3 --set seeds=3",
        folder.path());
    CHECK(rendered_runs(more) == 4);
  }
  SUBCASE("a scene may have a budget of the other kind") {
    const Outcome mixed =
        run_pharos("experiment test.yaml --set 'scenes.1.budget={ seconds: 0.05 }'", folder.path());
    CHECK(mixed.exit_code == 0);
    CHECK(rendered_runs(mixed) == 4);
    CHECK(test::bytes_of(folder.path() / "test/report.html").find("0.05 s in flat") !=
          std::string::npos);
  }
  SUBCASE("a method may have a budget, which replaces the budgets of scenes") {
    const Outcome more = run_pharos(
        "experiment test.yaml --set 'scenes.1.budget={ spp: 8 }' --set 'methods.1.budget={ spp: 20 "
        "}'",
        folder.path());
    REQUIRE_MESSAGE(more.exit_code == 0, more.err);
    CHECK(rendered_runs(more) == 6);  // all but the first method in the first scene
    CHECK(test::bytes_of(folder.path() / "test/report.html")
              .find("16 samples a pixel, training included; 8 samples a pixel in flat; 20 samples "
                    "a pixel for sobol") != std::string::npos);
    const Outcome both = run_pharos(
        "experiment test.yaml --set 'methods.1.budget={ spp: 4, seconds: 1 }'", folder.path());
    CHECK(both.exit_code == 2);
    CHECK(both.err.find("expected either 'spp' or 'seconds'") != std::string::npos);
  }
  SUBCASE("a message names an optional scene that is left out") {
    const std::string absent = "'scenes.1={ name: far, config: far/away.yaml, optional: true }'";
    const Outcome rest = run_pharos("experiment test.yaml --set " + absent, folder.path());
    REQUIRE_MESSAGE(rest.exit_code == 0, rest.err);
    CHECK(rest.err.find("far: left out") != std::string::npos);
    CHECK(rendered_runs(rest) == 0);
    CHECK(table_of(folder.path()).find("deep") != std::string::npos);
    CHECK(table_of(folder.path()).find("far") == std::string::npos);
  }
  SUBCASE("a method's config lies below its settings: the same in either is not rendered again") {
    folder.write("preset.yaml", "sampler: sobol\n");
    const std::string config = "--set 'methods.1={ name: sobol, config: preset.yaml";
    const Outcome same = run_pharos("experiment test.yaml " + config + " }'", folder.path());
    REQUIRE_MESSAGE(same.exit_code == 0, same.err);
    CHECK(rendered_runs(same) == 0);
    const Outcome over = run_pharos(
        "experiment test.yaml " + config + ", settings: { sampler: halton } }'", folder.path());
    CHECK(over.exit_code == 0);
    CHECK(rendered_runs(over) == 4);
    const Outcome missing = run_pharos(
        "experiment test.yaml --set 'methods.1={ name: sobol, config: none.yaml }'", folder.path());
    CHECK(missing.exit_code == 2);
    CHECK(missing.err.find("none.yaml") != std::string::npos);
  }
  SUBCASE("another number of threads gives the same table") {
    const std::string table = table_of(folder.path());
    fs::remove_all(folder.path() / "test");
    const Outcome threads = run_pharos("experiment test.yaml --threads 3", folder.path());
    CHECK(rendered_runs(threads) == 8);
    CHECK(table_of(folder.path()) == table);
  }
}

TEST_CASE("what an experiment reads is known by its content, wherever it lies") {
  const ScratchFolder folder;
  const auto write_mesh = [&](const std::string& name, const char* height) {
    folder.write(name, fmt::format("v -1 -1 {0}\nv 1 -1 {0}\nv 0 1 {0}\nf 1 2 3\n", height));
  };
  const auto run_with = [&](const std::string& mesh) {
    return run_pharos(
        "experiment test.yaml --set seeds=1 --set 'scenes.0.settings={ scene: { shapes: "
        "[{ type: mesh, file: " +
            mesh +
            " }], emitters: [{ type: constant }], sensor: { "
            "type: perspective, to_world: { look_at: { origin: [0, 0, 4], target: [0, 0, 0] "
            "} } } } }'",
        folder.path());
  };
  write_experiment(folder, "spp: 4", 1);
  write_mesh("a.obj", "0");
  const Outcome first = run_with("a.obj");
  REQUIRE_MESSAGE(first.exit_code == 0, first.err);
  CHECK(rendered_runs(first) == 4);
  CHECK(rendered_parts(first) == 8);
  write_mesh("b.obj", "0");
  const Outcome moved = run_with("b.obj");
  CHECK(rendered_runs(moved) == 0);
  CHECK(rendered_parts(moved) == 0);
  write_mesh("b.obj", "0.5");
  const Outcome changed = run_with("b.obj");
  CHECK(rendered_runs(changed) == 2);
  CHECK(rendered_parts(changed) == 4);
}

TEST_CASE("nothing of an earlier config stays") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 8", 2);
  const std::string stubs = std::string("PHAROS_MODULE_PATH=") + PHAROS_TEST_PLUGINS;
  const Outcome guided = run_pharos(
      "experiment test.yaml --set 'methods.1.settings={ integrator: { guiding: { learner: "
      "stub_direction, guider: stub_direction, training: { iterations: 2 } } } }'",
      folder.path(), stubs);
  REQUIRE_MESSAGE(guided.exit_code == 0, guided.err);
  CHECK(folder.has("test/runs/deep/sobol/seed-1.slice-x.exr"));

  const Outcome plain = run_pharos("experiment test.yaml", folder.path());
  CHECK(rendered_runs(plain) == 4);
  CHECK_FALSE(folder.has("test/runs/deep/sobol/seed-1.slice-x.exr"));

  // The first seed is rendered again if it has no image yet, or if its image has been deleted.
  const Outcome later =
      run_pharos("experiment test.yaml --set first_seed=2 --set seeds=1", folder.path());
  CHECK(rendered_runs(later) == 4);
  fs::remove(folder.path() / "test/runs/deep/sobol/seed-2.exr");
  CHECK(rendered_runs(run_pharos("experiment test.yaml --set first_seed=2 --set seeds=1",
                                 folder.path())) == 1);
}

TEST_CASE("an output folder belongs to one experiment, and to one set of configs at a time") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 4", 1);
  REQUIRE(run_pharos("experiment test.yaml", folder.path()).exit_code == 0);
  fs::copy_file(folder.path() / "test.yaml", folder.path() / "other.yaml");
  const Outcome other = run_pharos("experiment other.yaml -o test", folder.path());
  CHECK(other.exit_code == 2);
  CHECK(other.err.find("holds the results of '") != std::string::npos);

  const ScratchFolder elsewhere;
  const std::string same =
      fmt::format("experiment {0}/test.yaml -o {0}/test", folder.path().string());
  auto busy = std::async(std::launch::async, [&] {
    return interrupt_pharos_once("done", "experiment test.yaml --set seeds=10000 -q", folder.path(),
                                 "INT");
  });
  CHECK(appears(folder.path() / "test/runs/deep/independent/seed-2.json"));
  const Outcome second = run_pharos(same + " --set budget.spp=5", elsewhere.path());
  // Fewer runs of the same configs are no conflict.
  const Outcome third = run_pharos(same + " --set seeds=3", elsewhere.path());
  folder.write("done", "");
  CHECK(second.exit_code == 2);
  CHECK(second.err.find("another process is at work here, with other configs") !=
        std::string::npos);
  CHECK_MESSAGE(third.exit_code == 0, third.err);
  CHECK(busy.get().exit_code == 130);
  CHECK(run_pharos(same + " --set budget.spp=5", elsewhere.path()).exit_code == 0);
}

TEST_CASE("two processes that need one reference share it") {
  const ScratchFolder folder, elsewhere;
  write_experiment(folder, "spp: 4", 1);
  auto first = std::async(std::launch::async, [&] {
    return run_pharos("experiment test.yaml --set reference.spp=2048", folder.path());
  });
  const Outcome second =
      run_pharos(fmt::format("experiment {}/test.yaml -o out --set reference.spp=2048",
                             folder.path().string()),
                 elsewhere.path());
  CHECK(second.exit_code == 0);
  const Outcome other = first.get();
  CHECK(other.exit_code == 0);
  CHECK(rendered_parts(second) + rendered_parts(other) == 8);
}

TEST_CASE("a method that learns: checkpoints after training, sizes, pictures of its density") {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 32", 1);
  const Outcome outcome = run_pharos(
      "experiment test.yaml --set 'methods.1.settings={ integrator: { termination: adjoint, "
      "guiding: { learner: stub_direction, guider: stub_direction, training: { iterations: 4 } } } "
      "}'",
      folder.path(), std::string("PHAROS_MODULE_PATH=") + PHAROS_TEST_PLUGINS);
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  for (const char* picture : {"slice-x", "slice-y", "slice-z", "directions"}) {
    CHECK(folder.has(fmt::format("test/runs/deep/sobol/seed-1.{}.exr", picture)));
    CHECK_FALSE(folder.has(fmt::format("test/runs/deep/independent/seed-1.{}.exr", picture)));
  }
  // 16 samples of training, then 1, 2, 4, 8 and 16 further samples.
  std::istringstream in(test::bytes_of(folder.path() / "test" / "convergence.csv"));
  std::string samples;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("deep,sobol,1,", 0) == 0) samples += line.substr(13, line.find(',', 13) - 12);
  }
  CHECK(samples == "17,18,20,24,32,");
  const std::string report = test::bytes_of(folder.path() / "test/report.html");
  CHECK(report.find("model_bytes") != std::string::npos);
  // The papers of its plugins.
  CHECK(report.find("J. Vorba") != std::string::npos);
  const auto results =
      nlohmann::json::parse(test::bytes_of(folder.path() / "test" / "results.json"));
  CHECK(results["papers"].size() == 1);
  CHECK(results["papers"]["sobol"].dump().find("Adjoint-Driven") != std::string::npos);
}

TEST_CASE("long: runs of equal time end within 3 % of it") {
  const ScratchFolder folder;
  write_experiment(folder, "seconds: 10", 1, 128);
  Outcome outcome = interrupt_pharos("experiment test.yaml", folder.path(), 300, "KILL");
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  std::istringstream in(test::bytes_of(folder.path() / "test" / "convergence.csv"));
  std::string line;
  std::getline(in, line);
  int ends = 0;
  for (std::string next; !line.empty(); line = next) {
    const bool more = static_cast<bool>(std::getline(in, next));
    const auto run_of = [](const std::string& text) { return text.substr(0, text.find(",1,")); };
    if (line.rfind("scene,", 0) != 0 && (!more || run_of(next) != run_of(line))) {
      std::istringstream columns(line);
      std::string seconds;
      for (int i = 0; i < 5; ++i) std::getline(columns, seconds, ',');
      MESSAGE(run_of(line), ": ", seconds, " s");
      CHECK(std::stod(seconds) == doctest::Approx(10).epsilon(0.03));
      ++ends;
    }
    if (!more) break;
  }
  CHECK(ends == 4);
}

}  // namespace
}  // namespace pharos::testing
