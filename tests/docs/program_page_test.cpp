// The page of the program describes every command and every option.

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "program_help.h"

namespace pharos::docs {
namespace {

/// Returns the sections of the page by the commands in their headings, such as "## `pharos render
/// CONFIG`".
std::map<std::string, std::string> sections_of_commands() {
  constexpr std::string_view kHeading = "## `pharos ";
  std::map<std::string, std::string> sections;
  std::string* section = nullptr;
  std::ifstream in(source_tree() / "docs/reference/program.md");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) section = nullptr;
    if (line.starts_with(kHeading)) {
      const std::string rest = line.substr(kHeading.size());
      section = &sections[rest.substr(0, rest.find_first_of(" `"))];
    }
    if (section != nullptr) *section += line + "\n";
  }
  return sections;
}

/// Returns whether `text` names the option by itself or with its value: "`--set`", "`--set KEY".
bool names(const std::string& text, const std::string& option) {
  return text.find("`" + option + "`") != std::string::npos ||
         text.find("`" + option + " ") != std::string::npos;
}

}  // namespace

TEST_CASE("the page of the program: all commands and their options") {
  const Workbench bench;
  ProgramHelp help(bench);
  const auto sections = sections_of_commands();
  REQUIRE(help.subcommands().size() >= 10);
  std::set<std::string> described;
  for (const auto& [command, text] : sections) described.insert(command);
  CHECK(described == help.subcommands());
  for (const auto& section : sections) {
    const auto& command = section.first;
    const auto& text = section.second;
    // The page need not repeat the parameters of commands that the reference of plugins lists.
    if (text.find("pharos plugins " + command) != std::string::npos) continue;
    for (const std::string& option : help.options(command)) {
      CAPTURE(command);
      CAPTURE(option);
      CHECK((option == "-h" || option == "--help" || names(text, option)));
    }
  }
}

}  // namespace pharos::docs
