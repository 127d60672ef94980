#include "refusal.h"

#include <sstream>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace pharos::testing {
namespace {

/// More memory than any refusal needs, including sanitizers.
constexpr double kMostMegabytes = 1024;

/// Checks that a message is one line, or one line with a place for each of several flaws.
void check_lines(const std::string& message) {
  REQUIRE_FALSE(message.empty());
  CHECK(message.back() == '\n');
  if (message.find('\n') == message.size() - 1) return;
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) {
    const bool is_count = line.find("at least ") == 0;
    CHECK((is_count || line.find(": error: ") != std::string::npos));
  }
}

}  // namespace

void check_refused(const Mistake& mistake, const std::vector<std::string>& says) {
  const ScratchFolder folder;
  if (mistake.prepare) mistake.prepare(folder);
  const std::vector<std::string> before = folder.listing();
  const Outcome outcome = run_pharos(mistake.arguments, folder.path(), mistake.environment);
  CAPTURE(mistake.arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.out.empty());
  check_lines(outcome.err);
  for (const std::string& part : says) {
    CAPTURE(part);
    CHECK(outcome.err.find(part) != std::string::npos);
  }
  CHECK(outcome.peak_megabytes < kMostMegabytes);
  CHECK(folder.listing() == before);
}

void check_refused(const std::string& config, const std::vector<std::string>& says) {
  CAPTURE(config);
  check_refused({.arguments = "render bad.yaml",
                 .prepare = [&](const ScratchFolder& f) { f.write("bad.yaml", config); }},
                says);
}

void check_mesh_refused(const std::string& name, const std::string& text,
                        const std::string& place) {
  CAPTURE(text);
  check_refused({.arguments = "render bad.yaml",
                 .prepare =
                     [&](const ScratchFolder& f) {
                       f.write("bad.yaml", config_with_shape("{ type: mesh, file: " + name + " }"));
                       f.write(name, text);
                     }},
                {(place.empty() ? "bad.yaml:4:7" : name + ":" + place) + ": error: ", name});
}

std::string config_with(const std::string& more) {
  return "scene:\n  sensor: perspective\n  shapes: [sphere]\nbudget: { spp: 1 }\n" + more;
}

std::string config_with_shape(const std::string& shape) {
  return "scene:\n  sensor: perspective\n  shapes:\n    - " + shape + "\nbudget: { spp: 1 }\n";
}

}  // namespace pharos::testing
