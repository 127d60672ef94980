#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include <pharos/config/component.h>

namespace pharos {

/// Lets the caller of a command watch and stop its work.
struct CommandControl {
  /// May be set by any thread to end the work early. May be null.
  const std::atomic<bool>* stop = nullptr;
  /// Receives the share of the work that is done, in [0, 1]. Called by one thread at a time. May be
  /// empty.
  std::function<void(double fraction)> on_progress;
  /// Receives messages for people, one line each. Called by one thread at a time. May be empty.
  std::function<void(const std::string& message)> on_message;

  bool stopped() const { return stop != nullptr && *stop; }
  void progress(double fraction) const {
    if (on_progress) on_progress(fraction);
  }
  void tell(const std::string& message) const {
    if (on_message) on_message(message);
  }
};

enum class CommandEnd { done, stopped };

/// Contract: something that the program can do besides rendering, and that a module adds. Its
/// parameters are both keys of a config and options of the command line. A command that is
/// registered as `synthesize` with the parameter `points` is used as
///
///     pharos synthesize FILE.yaml --points 1024
///
/// The file may be left out, and options take precedence over it. Building a command checks its
/// settings and does nothing else; run() does the work.
class Command : public Component {
 public:
  static constexpr std::string_view contract_name = "command";

  /// Does the work, on as many threads as the caller allows. Files are written as a whole or not at
  /// all, even if the command is stopped. Throws InputError before long work if an output cannot be
  /// written, and RunError if the work cannot be done.
  virtual CommandEnd run(const CommandControl& control) const = 0;
};

}  // namespace pharos
