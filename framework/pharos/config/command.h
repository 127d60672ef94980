#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include <pharos/config/component.h>

namespace pharos {

/// How a command's work is watched and stopped.
struct CommandControl {
  /// Set by anyone to end the work early. May be null.
  const std::atomic<bool>* stop = nullptr;
  /// Told the share of the work that is done, in [0, 1], by one thread at a time. May be empty.
  std::function<void(double fraction)> on_progress;
  /// Told what people should know, a line each, by one thread at a time. May be empty.
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

/// Contract: something that the program can do besides rendering, which a module brings. Its
/// parameters are both the keys of a config and options of the command line: registered as
/// `synthesize` with the parameter `points` it is used as
///
///     pharos synthesize FILE.yaml --points 1024
///
/// where the file may be left out, and options win over it. Building a command checks its settings
/// and does nothing else; run() does the work.
class Command : public Component {
 public:
  static constexpr std::string_view contract_name = "command";

  /// Does the work, on as many threads as the caller allows. Files appear whole or not at all, also
  /// when it is stopped. Throws InputError before long work where an output cannot be written, and
  /// RunError where the work cannot be done.
  virtual CommandEnd run(const CommandControl& control) const = 0;
};

}  // namespace pharos
