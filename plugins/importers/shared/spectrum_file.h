#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "read_file.h"

namespace pharos::importing {

/// Values at increasing wavelengths [nm]: linear between them, 0 outside.
class WavelengthList {
 public:
  /// Adds the next pair. Returns a description of the error, or "" if the pair is valid.
  std::string add(double wavelength, double value);
  std::size_t size() const { return wavelengths_.size(); }
  double at(double wavelength) const;

 private:
  std::vector<double> wavelengths_, values_;
};

/// Reads the pairs of a file with one wavelength and one value per line; lines that begin with `#`
/// are comments. `path` must be a readable file, which takes from the budget. Throws InputError
/// with line and column for anything else in the file.
WavelengthList read_spectrum_file(const std::filesystem::path& path, ReadingBudget& budget);

}  // namespace pharos::importing
