#pragma once

#include <optional>

namespace pharos {

/// Starts a new measurement of the most memory that the process holds. Linux only; elsewhere, and
/// where the system does not allow it, peak_memory() is empty.
void reset_peak_memory();

/// The most memory resident since reset_peak_memory() [bytes].
std::optional<double> peak_memory();

}  // namespace pharos
