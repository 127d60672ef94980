#pragma once

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

/// Base of all errors that Pharos reports on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input is wrong: config, scene, mesh, image, model file or command line. The program exits
/// with code 2. The message starts with the location where there is one.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(message) {}
  InputError(const Location& where, const std::string& message)
      : Error(where.to_string() + ": error: " + message) {}
};

/// The input was fine, yet the work could not be done (disk full, lost file). Exit code 3.
class RunError : public Error {
 public:
  using Error::Error;
};

/// " (did you mean 'x'?)" when one of `known` is near `wrong`, else "".
std::string suggestion(std::string_view wrong, std::span<const std::string> known);

/// "'a', 'b', 'c'" in the given order; "none" when empty.
std::string quoted_list(std::span<const std::string> names);

}  // namespace pharos
