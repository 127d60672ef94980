#pragma once

#include <string>
#include <vector>

#include "markdown.h"
#include "workbench.h"

namespace pharos::docs {

/// What was found out about the command lines of a page.
struct CommandCheck {
  int checked = 0;                    ///< calls of `./run` and `pharos`
  int executed = 0;                   ///< those that were really run
  double seconds = 0;                 ///< that these took together
  std::vector<std::string> problems;  ///< a line each, with the line of the page
};

/// How commands are run: renders with few samples and a tiny film, and small pictures of models, or
/// exactly as the page has them.
enum class Pace { quick, as_written };

/// Checks every call of `./run` and `pharos` in fenced blocks of shell commands or without a
/// language: the subcommand and its options exist, and so do files of the repository. Runs the
/// commands that take little time, renders, and shows models that earlier commands of the page have
/// learned. Commands that leave something out, such as CONFIG or
/// "…", are not run, and neither are those that name a plugin that the page teaches to write.
CommandCheck check_commands(const Page& page, const Workbench& bench, Pace pace = Pace::quick);

}  // namespace pharos::docs
