#pragma once

#include <string>

namespace pharos {

/// Prints a message for people on standard error, as one line. Thread-safe. Errors are reported by
/// exceptions, not by log lines.
void log_info(const std::string& message);
void log_warning(const std::string& message);
/// Restricts the log to warnings if `quiet` is set.
void set_log_quiet(bool quiet);

}  // namespace pharos
