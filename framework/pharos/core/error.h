#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pharos {

/// Where a piece of input was written. Lines and columns count from 1; 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  /// "file:line:column", leaving out what is unknown.
  std::string to_string() const;
};

/// Base of all errors that Pharos reports on purpose. Messages are one line whatever names and
/// texts they quote: one_line() is applied to them.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message);
};

/// The input is wrong: config, scene, mesh, image, model file or command line. The program exits
/// with code 2. The message is one line and starts with the location where there is one.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(message) {}
  /// "file:line:column: error: message"; an unlocated error when nothing of `where` is known.
  InputError(const Location& where, const std::string& message)
      : Error(where.to_string().empty() ? message : where.to_string() + ": error: " + message),
        located_(!where.to_string().empty()) {}

  /// False when the message says what is wrong but not where: code that knows the place may catch
  /// the error and throw it again with the location.
  bool located() const { return located_; }

 private:
  bool located_ = false;
};

/// The input was fine, yet the work could not be done (disk full, lost file). Exit code 3.
class RunError : public Error {
 public:
  using Error::Error;
};

/// " (did you mean 'x'?)" when one of `known` is near `wrong`, else "". Near means at most a third
/// of `wrong`'s letters inserted, left out, replaced or swapped with their neighbor, and always
/// one; the nearest wins, then the first.
std::string suggestion(std::string_view wrong, std::span<const std::string> known);

/// The suggestion for a path that does not exist: the nearest name in its folder.
std::string file_suggestion(const std::filesystem::path& missing);

/// Why `path` cannot be read as a file: it does not exist (with the nearest name), is a folder, a
/// pipe or a device, or may not be read; "" when it can. Readers ask first: opening a pipe would
/// wait for ever.
std::string file_problem(const std::filesystem::path& path);

/// `text` on one line: line breaks become spaces, other control characters '?', and what exceeds
/// `max_length` bytes an ellipsis.
std::string one_line(std::string_view text, std::size_t max_length = 400);

/// "'a', 'b', 'c'" in the given order; "none" when empty.
std::string quoted_list(std::span<const std::string> names);

}  // namespace pharos
