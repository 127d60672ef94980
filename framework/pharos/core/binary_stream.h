#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string_view>
#include <type_traits>

#include <pharos/core/error.h>

/// What learned models and states are saved with: a line of text that names what follows and its
/// version, then bare numbers as they lie in memory, least byte first.
namespace pharos {

static_assert(std::endian::native == std::endian::little, "saved numbers are little-endian");

/// Begins something saved.
void save_heading(std::ostream& out, std::string_view name, std::uint32_t version);
/// Reads what save_heading() wrote. Throws InputError when anything else stands there.
void expect_heading(std::istream& in, std::string_view name, std::uint32_t version);

/// Writes a number.
template <class T>
void save_number(std::ostream& out, T value) {
  static_assert(std::is_arithmetic_v<T>);
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Reads a number of the type it was written as. Throws InputError when the stream ends before it.
template <class T>
T load_number(std::istream& in) {
  static_assert(std::is_arithmetic_v<T>);
  T value{};
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  if (!in) throw InputError("what was saved is cut off");
  return value;
}

/// As load_number(); throws for NaN and infinity too.
template <class T>
T load_finite(std::istream& in) {
  static_assert(std::is_floating_point_v<T>);
  const T value = load_number<T>(in);
  if (!std::isfinite(value)) throw InputError("what was saved is damaged");
  return value;
}

}  // namespace pharos
