#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "process.h"

namespace pharos::testing {

/// Writes an experiment with two scenes, two methods and `seeds` seeds. One run takes some 20 ms.
void write_experiment(const ScratchFolder& folder, const std::string& budget, int seeds,
                      int edge = 24);

/// Returns runs.csv without the columns that depend on the clock and the machine. The remaining
/// columns end with the samples, errors, counts and sizes of models.
std::string table_of(const std::filesystem::path& folder);

/// Returns the number of lines that report a finished run.
std::size_t rendered_runs(const Outcome& outcome);

/// Returns the number of rendered parts of references.
std::size_t rendered_parts(const Outcome& outcome);

/// Returns the table of an experiment that runs without interruption.
std::string undisturbed_table(int seeds);

}  // namespace pharos::testing
