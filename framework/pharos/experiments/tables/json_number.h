#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace pharos {

/// A number in JSON, which has no word for what is not finite: NaN is null, infinities are the
/// texts "Infinity" and "-Infinity", as JavaScript and Python read them.
template <class Json>
Json json_number(double value) {
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  return std::isnan(value) ? Json(nullptr) : Json(value);
}
template <class Json>
Json json_number(const std::optional<double>& value) {
  return value ? json_number<Json>(*value) : Json(nullptr);
}

/// The number that json_number() wrote; NaN for everything else.
template <class Json>
double number_from(const Json& node) {
  if (node.is_number()) return node.template get<double>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (node == "Infinity") return infinity;
  return node == "-Infinity" ? -infinity : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace pharos
