#pragma once

#include <string>

namespace pharos {

/// Messages to people, on the standard error stream, one line each; thread-safe. Errors are
/// exceptions, not log lines.
void log_info(const std::string& message);
void log_warning(const std::string& message);
/// Leaves only warnings.
void set_log_quiet(bool quiet);

}  // namespace pharos
