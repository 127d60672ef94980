#pragma once

#include <map>
#include <set>
#include <string>

#include "workbench.h"

namespace pharos::docs {

/// The names that the program and the script `run` know.
class ProgramHelp {
 public:
  explicit ProgramHelp(const Workbench& bench) : bench_(bench) {}

  /// Returns the subcommands of `pharos`.
  const std::set<std::string>& subcommands();
  /// Returns the options of a subcommand, such as "-o" and "--output".
  const std::set<std::string>& options(const std::string& subcommand);
  /// Returns the commands of the script `run`.
  static const std::set<std::string>& script_commands();

 private:
  const Workbench& bench_;
  std::set<std::string> subcommands_;
  std::map<std::string, std::set<std::string>> options_;
};

}  // namespace pharos::docs
