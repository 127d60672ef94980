#include "spectrum_file.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <pharos/core/error.h>

#include "numbers.h"

namespace pharos::importing {
namespace {

constexpr std::size_t kMostPairs = 100'000;

void add_line(WavelengthList& list, std::string_view line, const Location& where) {
  const std::vector<std::string_view> pair = words(line);
  if (pair.empty() || pair[0].starts_with('#')) return;
  const auto wavelength = parse_number(pair[0]);
  const auto value = pair.size() == 2 ? parse_number(pair[1]) : std::nullopt;
  if (!wavelength || !value) {
    throw InputError(
        where, fmt::format("expected a wavelength and a value, found '{}'", one_line(line, 40)));
  }
  const std::string problem = list.add(*wavelength, *value);
  if (!problem.empty()) throw InputError(where, problem);
}

}  // namespace

std::string WavelengthList::add(double wavelength, double value) {
  if (size() == kMostPairs) return fmt::format("expected at most {} wavelengths", kMostPairs);
  if (!wavelengths_.empty() && !(wavelength > wavelengths_.back())) {
    return fmt::format("expected rising wavelengths, found {} after {}", wavelength,
                       wavelengths_.back());
  }
  wavelengths_.push_back(wavelength);
  values_.push_back(value);
  return "";
}

double WavelengthList::at(double wavelength) const {
  const auto next = std::upper_bound(wavelengths_.begin(), wavelengths_.end(), wavelength);
  if (next == wavelengths_.begin()) return 0;
  if (next == wavelengths_.end()) return wavelength > wavelengths_.back() ? 0 : values_.back();
  const auto i = static_cast<std::size_t>(next - wavelengths_.begin());
  const double t = (wavelength - wavelengths_[i - 1]) / (wavelengths_[i] - wavelengths_[i - 1]);
  return (1 - t) * values_[i - 1] + t * values_[i];
}

WavelengthList read_spectrum_file(const std::filesystem::path& path, ReadingBudget& budget) {
  const std::string text = read_file(path, budget);
  WavelengthList list;
  int line = 0;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string_view here = std::string_view(text).substr(begin, end - begin);
    add_line(list, here, {path.string(), ++line, 1});
  }
  if (list.size() < 2) {
    throw InputError(Location{path.string()},
                     "expected at least two pairs of wavelength and value");
  }
  return list;
}

}  // namespace pharos::importing
