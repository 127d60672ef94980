#include "small_experiment.h"

#include <sstream>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace pharos::testing {

void write_experiment(const ScratchFolder& folder, const std::string& budget, int seeds, int edge) {
  folder.write("render.yaml", fmt::format(R"(scene: '{}/cornell-box/scene.yaml'
film: {{ width: {}, height: {}, filter: box }}
integrator: {{ type: path }}
budget: {{ spp: 1 }}
)",
                                          PHAROS_SCENES, edge, edge));
  folder.write("test.yaml", fmt::format(R"(title: A small experiment
scenes:
  - {{ name: deep, config: render.yaml }}
  - {{ name: flat, config: render.yaml, settings: {{ integrator: {{ max_depth: 2 }} }} }}
methods:
  - {{ name: independent, settings: {{ sampler: independent }} }}
  - {{ name: sobol, settings: {{ sampler: sobol }} }}
budget: {{ {} }}
seeds: {}
reference: {{ spp: 64, parts: 4 }}
cache: cache
)",
                                        budget, seeds));
}

std::string table_of(const std::filesystem::path& folder) {
  constexpr int kTimeless = 20;
  std::istringstream in(test::bytes_of(folder / "test" / "runs.csv"));
  std::string table;
  for (std::string line; std::getline(in, line);) {
    std::istringstream columns(line);
    std::string column;
    for (int i = 0; i < kTimeless && std::getline(columns, column, ','); ++i) table += column + ",";
    table += "\n";
  }
  return table;
}

std::size_t rendered_runs(const Outcome& outcome) {
  std::size_t count = 0;
  std::istringstream in(outcome.err);
  for (std::string line; std::getline(in, line);) count += line.find(" s left") != line.npos;
  return count;
}

std::size_t rendered_parts(const Outcome& outcome) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = outcome.err.find("reference, part", at)) != std::string::npos;
       ++at) {
    ++count;
  }
  return count;
}

std::string undisturbed_table(int seeds) {
  const ScratchFolder folder;
  write_experiment(folder, "spp: 16", seeds);
  const Outcome outcome = run_pharos("experiment test.yaml", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  return table_of(folder.path());
}

}  // namespace pharos::testing
