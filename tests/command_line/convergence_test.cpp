// `pharos convergence` from the command line: files, refusals, stopping.

#include <doctest/doctest.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

/// A valid file of seven lines. Line `line` is replaced by the given text (0: no line is replaced).
std::string file(int line = 0, const std::string& text = "") {
  std::vector<std::string> lines{"title: Small",
                                 "integrands:",
                                 "  - { name: edge, integrand: { type: edge, angles: [30] } }",
                                 "samplers:",
                                 "  - { name: random, sampler: independent }",
                                 "samples: { from: 4, to: 8 }",
                                 "realizations: 32"};
  if (line > 0) lines[static_cast<std::size_t>(line) - 1] = text;
  std::string yaml;
  for (const std::string& each : lines) yaml += each + "\n";
  return yaml;
}

Mistake wrong(int line, const std::string& text) {
  return {.arguments = "convergence bad.yaml", .prepare = [=](const ScratchFolder& folder) {
            folder.write("bad.yaml", file(line, text));
          }};
}

TEST_CASE("convergence: tables, files, and the same bits for any number of threads") {
  const ScratchFolder folder;
  folder.write("good.yaml", file());
  const Outcome one = run_pharos("convergence good.yaml --threads 1", folder.path());
  REQUIRE_MESSAGE(one.exit_code == 0, one.err);
  CHECK(one.out.find("random") != std::string::npos);
  for (const char* name : {"results.json", "report.html", "variances.csv"}) {
    CHECK(folder.has(std::string("good/") + name));
  }
  const Outcome three = run_pharos("convergence good.yaml --threads 3 -o other -q", folder.path());
  REQUIRE_MESSAGE(three.exit_code == 0, three.err);
  CHECK(three.err.empty());
  CHECK(three.out == one.out);
}

TEST_CASE("convergence: every registered sampler by default") {
  const ScratchFolder folder;
  folder.write("all.yaml",
               "integrands:\n  - { name: edge, integrand: edge }\n"
               "samples: { from: 4, to: 6 }\nrealizations: 16\n");
  const Outcome outcome = run_pharos("convergence all.yaml", folder.path());
  REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
  for (const char* sampler : {"\nindependent ", "\nsobol "}) {
    CHECK(outcome.out.find(sampler) != std::string::npos);
  }
}

TEST_CASE("convergence: keys and values") {
  check_refused(wrong(1, "titel: Small"), {"bad.yaml:1:1: error: ", "did you mean 'title'?"});
  check_refused(wrong(2, "integrand:"), {"bad.yaml:2:1: error: ", "did you mean 'integrands'?"});
  check_refused(wrong(6, "samples: { from: 4, to: 5 }"), {"bad.yaml:6:10: error: ", "at least 2"});
  check_refused(wrong(6, "samples: { from: 4, to: 17 }"),
                {"bad.yaml:6:25: error: ", "at most 16", "2^16 points"});
  check_refused(wrong(6, "fit: { from: 3, to: 9 }"),
                {"bad.yaml:6:6: error: ", "4 to 16, found 3 to 9"});
  check_refused(wrong(7, "realizations: 2"), {"bad.yaml:7:15: error: ", ">= 16"});
  check_refused(wrong(7, "preparations: 4"), {"bad.yaml:7:15: error: ", ">= 8"});
  check_refused(wrong(7, "baseline: rnadom"),
                {"bad.yaml:7:11: error: ", "one of 'random'", "did you mean 'random'?"});
  check_refused(wrong(7, "spectrum: { points: 100 }"),
                {"bad.yaml:7:21: error: ", "0 or a power of two"});
}

TEST_CASE("convergence: integrands and samplers") {
  check_refused(wrong(3, "  - { name: edge, integrand: { type: egde } }"),
                {"bad.yaml:3:38: error: ", "unknown integrand", "did you mean 'edge'?"});
  check_refused(wrong(3, "  - { name: edge, integrand: { type: edge, angels: [3] } }"),
                {"bad.yaml:3:44: error: ", "did you mean 'angles'?"});
  check_refused(
      wrong(3, "  - { name: edge, integrand: { type: edge, angles: [0, 1], offsets: [1] } }"),
      {"bad.yaml:3:30: error: ", "as many offsets as angles"});
  check_refused(wrong(3, "  - { name: disk, integrand: { type: disk, radius: 2 } }"),
                {"bad.yaml:3:30: error: ", "found all of it inside"});
  check_refused(wrong(3, "  - { name: a/b, integrand: disk }"),
                {"bad.yaml:3:13: error: ", "letters, digits"});
  check_refused(wrong(5, "  - { name: a, sampler: sobol }\n  - { name: a, sampler: sobol }"),
                {"bad.yaml:6:5: error: ", "'a' stands twice in 'samplers'"});
  check_refused(wrong(5, "  - { name: a, sampler: sobbol }"),
                {"bad.yaml:5:25: error: ", "did you mean 'sobol'?"});
  check_refused(wrong(5, "  []"), {"bad.yaml", "'samplers'"});
}

TEST_CASE("convergence: the command") {
  check_refused(Mistake{.arguments = "convergence"}, {"config"});
  check_refused(Mistake{.arguments = "convergence none.yaml"}, {"none.yaml"});
  Mistake taken = wrong(0, "");
  taken.prepare = [prepare = taken.prepare](const ScratchFolder& folder) {
    prepare(folder);
    folder.write("bad", "a file where the folder should be");
  };
  check_refused(taken, {"bad"});
}

TEST_CASE("convergence: interrupted before it has results, it writes none") {
  const ScratchFolder folder;
  folder.write("long.yaml", file(7, "realizations: 1000000"));
  const Outcome outcome = interrupt_pharos_once(
      "long/experiment.source", "convergence long.yaml --set samples.from=14 --set samples.to=16",
      folder.path(), "INT");
  CHECK(outcome.exit_code == 130);
  CHECK_FALSE(folder.has("long/results.json"));
}

}  // namespace
}  // namespace pharos::testing
