#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pharos {

/// The place where a piece of input was written. Lines and columns count from 1; 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  /// Returns "file:line:column" without the parts that are unknown.
  std::string to_string() const;
};

/// The base class of all errors that Pharos reports on purpose. A message is always one line,
/// whatever names and texts it quotes, because one_line() is applied to it.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message);
};

/// The input is wrong: config, scene, mesh, image, model file or command line. The program exits
/// with code 2. The message is one line and starts with the location if it is known.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(message) {}
  /// The message becomes "file:line:column: error: message". The error is unlocated if nothing of
  /// `where` is known.
  InputError(const Location& where, const std::string& message)
      : Error(where.to_string().empty() ? message : where.to_string() + ": error: " + message),
        where_(std::make_shared<const Location>(where)) {}

  /// The place of the flaw. All its parts are unknown if the error is unlocated.
  Location where() const { return where_ != nullptr ? *where_ : Location(); }
  /// Returns false if the message says what is wrong but not where. Code that knows the location
  /// may catch the error and throw it again with the location.
  bool located() const { return !where().to_string().empty(); }

 private:
  std::shared_ptr<const Location> where_;  ///< shared: copies must not throw; may be null
};

/// Several flaws of one input. The message is the first flaw's.
class InputErrors : public InputError {
 public:
  /// At least one error.
  explicit InputErrors(std::vector<InputError> all);
  /// In the order in which they were found.
  const std::vector<InputError>& all() const { return *all_; }

 private:
  std::shared_ptr<const std::vector<InputError>> all_;  ///< shared: copies must not throw
};

/// Collects the errors of parts of an input that can be read independently, so that one run reports
/// all of them:
///
///     InputErrorList errors;
///     for (const ConfigNode& item : items) errors.attempt([&] { read(item); });
///     errors.raise();
class InputErrorList {
 public:
  /// Calls `read` and returns true, or keeps the InputError that it throws and returns false. Equal
  /// errors are kept once.
  template <class Read>
  bool attempt(Read&& read) {
    try {
      read();
      return true;
    } catch (const InputErrors& errors) {
      for (const InputError& error : errors.all()) add(error);
    } catch (const InputError& error) {
      add(error);
    }
    return false;
  }

  /// Keeps an error, unless it equals one that is kept. Throws all of them when there are 100.
  void add(const InputError& error);

  /// Throws the error that was kept, or InputErrors if there are several. Does nothing if there is
  /// none.
  void raise() const;

 private:
  std::vector<InputError> errors_;
};

/// The input is valid, but the work could not be done (disk full, lost file). The program exits
/// with code 3.
class RunError : public Error {
 public:
  using Error::Error;
};

/// Returns " (did you mean 'x'?)" if one of `known` is near `wrong`, else "". A name is near if the
/// number of edits is at most a third of the number of letters in `wrong`; one edit is always
/// allowed. An edit inserts, omits or replaces a letter or swaps two neighbors. The nearest name is
/// suggested, and the first one if several are equally near.
std::string suggestion(std::string_view wrong, std::span<const std::string> known);

/// Returns the suggestion for a path that does not exist: the nearest name in its folder.
std::string file_suggestion(const std::filesystem::path& missing);

/// Returns why `path` cannot be read as a file: it does not exist (with the nearest name), is a
/// folder, a pipe or a device, or may not be read. Returns "" if it can be read. Code calls this
/// before it opens a file, because opening a pipe could wait forever.
std::string access_problem(const std::filesystem::path& path);

/// As access_problem(), for files that configs and scenes name: these must also lie below the
/// folder of confine_reading().
std::string file_problem(const std::filesystem::path& path);

/// Returns `text` on one line. Line breaks become spaces and other control characters become '?'.
/// Text beyond `max_length` bytes is replaced by an ellipsis.
std::string one_line(std::string_view text, std::size_t max_length = 400);

/// Returns "'a', 'b', 'c'" in the given order, or "none" if `names` is empty.
std::string quoted_list(std::span<const std::string> names);

}  // namespace pharos
