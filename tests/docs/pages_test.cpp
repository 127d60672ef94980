// The pages of the documentation hold: their blocks of YAML are valid, their command lines run, and
// their links lead somewhere.

#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/tests/fixtures.h>

#include "command_lines.h"
#include "config_blocks.h"
#include "links.h"
#include "source_pages.h"

namespace pharos::docs {
namespace {

/// The pages of the source tree, and the reference of plugins as the program writes it now.
const SourcePages& all_pages() {
  static const SourcePages pages = [] {
    SourcePages result = read_source_pages(source_tree());
    const testing::ScratchFolder folder;
    const testing::Outcome outcome = testing::run_pharos("plugins --markdown", folder.path());
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    add_page(result, kPluginReference, outcome.out);
    return result;
  }();
  return pages;
}

/// The least share of blocks of YAML that are validated: most of what pages show can be copied.
constexpr double kLeastValidated = 0.7;

/// Counts of blocks of YAML.
struct Counts {
  int validated = 0, parsed = 0, skipped = 0;

  int all() const { return validated + parsed + skipped; }
  void add(Depth depth) {
    (depth == Depth::validated ? validated : depth == Depth::parsed ? parsed : skipped) += 1;
  }
};

/// The conformance suites build the examples of plugins, so their reference is not read here.
void check_blocks(const SourcePage& source, Counts& counts) {
  if (source.file == kPluginReference) return;
  const Workbench bench;
  for (const Fence& fence : source.page.fences) {
    if (fence.language != "yaml") continue;
    const BlockCheck check = check_block(fence.text, bench);
    counts.add(check.depth);
    if (check.problem.empty()) continue;
    FAIL_CHECK(fmt::format("{}:{}: {}", source.file.string(), fence.line, check.problem));
  }
}

TEST_CASE("pages: there are some, and their fenced blocks end") {
  CHECK(all_pages().pages.size() > 40);
  CHECK(all_pages().find("docs/contributing.md") != nullptr);
  for (const SourcePage& source : all_pages().pages) {
    CAPTURE(source.file.string());
    CHECK(source.page.open_fence == 0);
  }
}

TEST_CASE("pages: blocks of YAML are valid") {
  Counts counts;
  for (const SourcePage& source : all_pages().pages) check_blocks(source, counts);
  MESSAGE(fmt::format("{} blocks of YAML: {} validated, {} parsed, {} skipped", counts.all(),
                      counts.validated, counts.parsed, counts.skipped));
  CHECK(counts.all() >= 10);
  CHECK(counts.validated >= kLeastValidated * counts.all());
}

TEST_CASE("pages: command lines exist, and the cheap ones run") {
  int checked = 0, executed = 0;
  for (const SourcePage& source : all_pages().pages) {
    const Workbench bench;
    save_named_blocks(source.page.fences, bench);
    const CommandCheck check = check_commands(source.page, bench);
    checked += check.checked;
    executed += check.executed;
    for (const std::string& problem : check.problems) {
      FAIL_CHECK(fmt::format("{}: {}", source.file.string(), problem));
    }
  }
  MESSAGE(fmt::format("{} commands: {} were run", checked, executed));
  CHECK(checked >= 30);
  CHECK(executed >= 10);
}

TEST_CASE("long: the commands of the tutorial take less than ten minutes on two cores") {
  const SourcePage* tutorial = all_pages().find("docs/tutorial.md");
  REQUIRE(tutorial != nullptr);
  const Workbench bench;
  save_named_blocks(tutorial->page.fences, bench);
  const CommandCheck check = check_commands(tutorial->page, bench, Pace::as_written);
  for (const std::string& problem : check.problems) FAIL_CHECK(problem);
  MESSAGE(fmt::format("{} commands of the tutorial took {:.0f} s", check.executed, check.seconds));
  CHECK(check.executed >= 15);
  CHECK(check.seconds < 600);
}

TEST_CASE("pages: the papers of all plugins are on the page on citing") {
  std::string page = test::bytes_of(source_tree() / "docs" / "citing.md");
  std::erase(page, '*');  // titles are in italics
  const testing::ScratchFolder folder;
  std::istringstream reference(testing::run_pharos("plugins --markdown", folder.path()).out);
  const std::string mark = "Paper: ";
  int papers = 0;
  for (std::string line; std::getline(reference, line);) {
    if (!line.starts_with(mark)) continue;
    ++papers;
    CHECK_MESSAGE(page.find(line.substr(mark.size())) != std::string::npos, line);
  }
  CHECK(papers >= 10);
}

TEST_CASE("pages: links lead to files and headings") {
  for (const std::string& problem : dead_links(all_pages())) FAIL_CHECK(problem);
}

}  // namespace
}  // namespace pharos::docs
