#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pharos::docs {

/// A command as a shell reads it.
struct ShellCommand {
  std::vector<std::string> words;  ///< without quotes
  std::size_t line = 0;            ///< line of its first word in the text, from 0
};

/// Splits a text into commands: at ends of lines, `;`, `&&`, `||` and `|`. Knows quotes,
/// backslashes and comments, and leaves out redirections. An unfinished quotation ends with the
/// text.
std::vector<ShellCommand> shell_commands(std::string_view text);

/// Returns a word in quotes, as a shell reads it.
std::string quoted(const std::string& word);

}  // namespace pharos::docs
