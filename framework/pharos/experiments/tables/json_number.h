#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace pharos {

/// Converts a number to JSON, which cannot represent values that are not finite. NaN becomes null,
/// and infinities become the strings "Infinity" and "-Infinity", as JavaScript and Python read
/// them.
template <class Json>
Json json_number(double value) {
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  return std::isnan(value) ? Json(nullptr) : Json(value);
}
template <class Json>
Json json_number(const std::optional<double>& value) {
  return value ? json_number<Json>(*value) : Json(nullptr);
}

/// Returns the number that json_number() wrote; NaN for everything else.
template <class Json>
double number_from(const Json& node) {
  if (node.is_number()) return node.template get<double>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (node == "Infinity") return infinity;
  return node == "-Infinity" ? -infinity : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace pharos
