#include "decimal.h"

#include <algorithm>
#include <string_view>
#include <system_error>

#include <pharos/core/vec.h>

namespace pharos {
namespace {

/// Returns whether a number outside the range of double is too small rather than too large. The
/// decimal place of its first significant digit decides.
bool is_tiny(std::string_view number) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, e);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  double exponent = 0;
  if (e < number.size()) {
    const std::size_t sign = number[e + 1] == '+' ? 1 : 0;
    read_decimal(number.data() + e + 1 + sign, number.data() + number.size(), exponent);
  }
  return exponent + static_cast<double>(point) < static_cast<double>(first);
}

}  // namespace

std::from_chars_result read_decimal(const char* first, const char* last, double& value) {
  std::from_chars_result result = std::from_chars(first, last, value);
  if (result.ec == std::errc::result_out_of_range) {
    const double infinity = *first == '-' ? -kInfinity : kInfinity;
    value = is_tiny({first, result.ptr}) ? 0 : infinity;
    result.ec = {};
  }
  return result;
}

}  // namespace pharos
