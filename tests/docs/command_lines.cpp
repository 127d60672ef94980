#include "command_lines.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <optional>
#include <regex>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program_help.h"
#include "shell_words.h"
#include "source_pages.h"

namespace pharos::docs {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

constexpr auto kShellLanguages =
    std::to_array<std::string_view>({"", "sh", "bash", "console", "shell"});
/// Subcommands that write nothing but what they are asked for and take little time.
constexpr auto kCheapCommands = std::to_array<std::string_view>({"plugins", "validate", "points"});
/// Files that commands make. `render` also makes PNG images, `experiment` pages.
constexpr auto kOutputs = std::to_array<std::string_view>({".exr", ".html", ".model", ".png"});

/// A budget of either kind is replaced. One sample would leave nothing to train a guide with.
constexpr const char* kSmallRender =
    " --set 'budget={ spp: 4 }' --set film.width=16 --set film.height=16";

template <class List>
bool is_among(const List& list, std::string_view value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// A call of `./run` or `pharos`.
struct Call {
  bool by_script = false;  ///< `./run NAME`, but not `./run pharos NAME`
  bool in_place = true;    ///< no environment variables stand before it
  std::string name;        ///< of the command
  Words arguments;         ///< behind the name
};

bool is_assignment(const std::string& word) {
  static const std::regex pattern("[A-Z_]+=.*");
  return std::regex_match(word, pattern);
}

/// Returns a null option if the command calls another program.
std::optional<Call> call_of(const ShellCommand& command) {
  Call call;
  auto word = command.words.begin();
  const auto end = command.words.end();
  if (word != end && *word == "$") ++word;  // a prompt
  for (; word != end && is_assignment(*word); ++word) call.in_place = false;
  if (end - word < 2 || (*word != "./run" && *word != "pharos")) return std::nullopt;
  call.by_script = *word++ == "./run";
  if (call.by_script && *word == "pharos") {
    call.by_script = false;
    ++word;
  }
  // A command on several ranks has the same arguments as alone.
  if (call.by_script && *word == "--with-mpi" && end - word > 2) word += 2;
  if (word != end) call.name = *word++;
  if (call.name.ends_with(',')) call.name.pop_back();  // a list of commands
  call.arguments.assign(word, end);
  return call;
}

/// Whether a word is an option. Negative numbers are values.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

/// Returns the option that a word names, without its value and without the brackets of a synopsis,
/// as in "[--json FILE]". Returns an empty string for other words.
std::string option_of(std::string word) {
  if (word.starts_with('[')) word.erase(0, 1);
  if (!is_option(word)) return {};
  return word.substr(0, word.find_first_of("=]"));
}

/// Whether the reader has to put something else in the place of a word.
bool is_to_fill(const std::string& word) {
  static const std::regex capitals(R"([A-Z]+(\.\w+)?|\[.*|.*[A-Z]{4,})");
  return word.find("…") != std::string::npos || word.find("...") != std::string::npos ||
         word.find_first_of("$~*") != std::string::npos || std::regex_match(word, capitals);
}

/// Whether a word must name a file that is there: one in a folder of the repository, or a config or
/// scene anywhere.
bool names_input(const std::string& word) {
  const fs::path path = word;
  const std::string extension = path.extension();
  if (is_option(word) || is_to_fill(word) || is_among(kOutputs, extension)) return false;
  if (word.find_first_of(" \n{=") != std::string::npos) return false;
  const bool has_folder = word.find('/') != std::string::npos;
  return extension == ".yaml" || extension == ".xml" ||
         (has_folder && is_among(kSourceFolders, path.begin()->string()));
}

/// Returns the names under which the C++ code of a page registers plugins.
std::set<std::string> taught_plugins(const Page& page) {
  static const std::regex registration(R"re(registry\.add<[^(]*>\("([^"]+)")re");
  std::set<std::string> names;
  for (const Fence& fence : page.fences) {
    for (std::sregex_iterator i(fence.text.begin(), fence.text.end(), registration), end; i != end;
         ++i) {
      names.insert((*i)[1]);
    }
  }
  return names;
}

class Checker {
 public:
  Checker(const Page& page, const Workbench& bench, Pace pace)
      : page_(page), bench_(bench), pace_(pace), help_(bench), taught_(taught_plugins(page)) {}

  CommandCheck check() {
    for (const Fence& fence : page_.fences) {
      if (!is_among(kShellLanguages, fence.language)) continue;
      for (const ShellCommand& command : shell_commands(fence.text)) {
        const std::optional<Call> call = call_of(command);
        if (!call) continue;
        ++result_.checked;
        const std::string problem = problem_of(*call);
        if (problem.empty()) continue;
        result_.problems.push_back(fmt::format("line {}: {}: {}", fence.line + 1 + command.line,
                                               fmt::join(command.words, " "), problem));
      }
    }
    return result_;
  }

 private:
  std::string problem_of(const Call& call) {
    const bool of_program = help_.subcommands().contains(call.name);
    if (call.by_script) {
      if (!help_.script_commands().contains(call.name)) {
        return fmt::format("./run has no command '{}'", call.name);
      }
      if (!of_program) return {};  // tests, benchmarks: not the program's
    } else if (!of_program) {
      return is_option(call.name) ? "" : fmt::format("pharos has no command '{}'", call.name);
    }
    if (const std::string problem = problem_of_arguments(call); !problem.empty()) return problem;
    return is_to_run(call) ? problem_of_run(call) : "";
  }

  std::string problem_of_arguments(const Call& call) {
    bool is_output = false;
    for (const std::string& word : call.arguments) {
      if (const std::string option = option_of(word); !option.empty()) {
        if (!help_.options(call.name).contains(option)) {
          return fmt::format("'{}' has no option '{}'", call.name, option);
        }
      } else if (!is_output && names_input(word) && !bench_.has(word)) {
        return fmt::format("there is no '{}'", word);
      }
      is_output = word == "-o" || word == "--output";
    }
    return {};
  }

  bool is_to_run(const Call& call) const {
    const Words& words = call.arguments;
    if (!call.in_place || std::any_of(words.begin(), words.end(), is_to_fill)) return false;
    const auto is_taught = [&](const std::string& word) { return taught_.contains(word); };
    if (std::any_of(words.begin(), words.end(), is_taught)) return false;
    if (is_among(kCheapCommands, call.name)) return true;
    if (words.empty()) return false;
    return call.name == "render" ||
           (call.name == "inspect" && fs::exists(bench_.path() / words.front()));
  }

  std::string problem_of_run(const Call& call) {
    std::string line = call.name;
    for (const std::string& word : call.arguments) line += " " + quoted(word);
    // A replayed path is one of the film and of the samples that the config states.
    if (pace_ == Pace::quick) {
      if (call.name == "render" && !is_among(call.arguments, "--replay")) line += kSmallRender;
      if (call.name == "inspect" && !is_among(call.arguments, "--size")) line += " --size 64";
    }
    ++result_.executed;
    const auto start = std::chrono::steady_clock::now();
    const testing::Outcome outcome = bench_.run(line);
    result_.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (outcome.exit_code == 0) return {};
    return fmt::format("exit code {}: {}", outcome.exit_code, outcome.err);
  }

  const Page& page_;
  const Workbench& bench_;
  Pace pace_;
  ProgramHelp help_;
  std::set<std::string> taught_;
  CommandCheck result_;
};

}  // namespace

CommandCheck check_commands(const Page& page, const Workbench& bench, Pace pace) {
  return Checker(page, bench, pace).check();
}

}  // namespace pharos::docs
