#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "read_file.h"

namespace pharos::mitsuba {

/// Values at rising wavelengths [nm]: linear between them, 0 outside.
class WavelengthList {
 public:
  /// Takes the next pair; returns what is wrong with it, "" when nothing is.
  std::string add(double wavelength, double value);
  std::size_t size() const { return wavelengths_.size(); }
  double at(double wavelength) const;

 private:
  std::vector<double> wavelengths_, values_;
};

/// The pairs of a file with a wavelength and a value in each line; lines that begin with `#` are
/// comments. `path` must be a file that can be read, which takes from the budget. Throws InputError
/// with line and column for everything else.
WavelengthList read_spectrum_file(const std::filesystem::path& path, ReadingBudget& budget);

}  // namespace pharos::mitsuba
