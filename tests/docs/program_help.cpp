#include "program_help.h"

#include <fstream>
#include <regex>
#include <sstream>

namespace pharos::docs {
namespace {

void split_into(std::set<std::string>& parts, const std::string& text, char separator) {
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.insert(part);
}

/// Returns the alternatives of the script's `case $command in`.
std::set<std::string> read_script_commands() {
  static const std::regex alternatives(R"(  ([a-z]+(?: \| [a-z]+)*)\))"), space(" ");
  std::set<std::string> commands;
  std::ifstream in(source_tree() / "run");
  for (std::string line; std::getline(in, line);) {
    std::smatch parts;
    if (!std::regex_match(line, parts, alternatives)) continue;
    split_into(commands, std::regex_replace(parts[1].str(), space, ""), '|');
  }
  return commands;
}

}  // namespace

const std::set<std::string>& ProgramHelp::subcommands() {
  if (!subcommands_.empty()) return subcommands_;
  std::istringstream help(bench_.run("--help").out);
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (listed && line.starts_with("  "))
      subcommands_.insert(line.substr(2, line.find(' ', 2) - 2));
    if (line.starts_with("Subcommands:")) listed = true;
  }
  return subcommands_;
}

const std::set<std::string>& ProgramHelp::options(const std::string& subcommand) {
  const auto [entry, is_new] = options_.try_emplace(subcommand);
  if (!is_new) return entry->second;
  std::istringstream help(bench_.run(subcommand + " --help").out);
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  -")) continue;
    const std::string names = line.substr(2, line.find_first_of(" =", 2) - 2);
    split_into(entry->second, names, ',');
  }
  return entry->second;
}

const std::set<std::string>& ProgramHelp::script_commands() {
  static const std::set<std::string> commands = read_script_commands();
  return commands;
}

}  // namespace pharos::docs
