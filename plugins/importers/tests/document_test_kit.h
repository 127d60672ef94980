#pragma once

#include <map>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../document/document.h"

namespace pharos::mitsuba {

/// Reads `text` as the file scene.xml of a folder of its own.
inline Document read_text(std::string_view text,
                          const std::map<std::string, std::string>& parameters = {}) {
  const test::TemporaryFolder folder;
  return read_document(folder.write("scene.xml", text), parameters);
}

/// Reads what stands in a scene of dialect 0.x or 2/3.
inline Document read_old(const std::string& inside) {
  return read_text("<scene version=\"0.6.0\">" + inside + "</scene>");
}
inline Document read_new(const std::string& inside) {
  return read_text("<scene version=\"3.0.0\">" + inside + "</scene>");
}

/// The value of the property `name`, or of one without a name.
template <class T>
T value(const Object& object, std::string_view name = "") {
  const Property* const property = object.find(name);
  REQUIRE(property != nullptr);
  REQUIRE(std::holds_alternative<T>(property->value));
  return std::get<T>(property->value);
}

/// The object in the property `name`, or in the first without a name.
inline const Object& child(const Object& object, std::string_view name = "") {
  const Property* const property = object.find(name);
  REQUIRE(property != nullptr);
  const auto* const nested = std::get_if<std::shared_ptr<const Object>>(&property->value);
  REQUIRE(nested != nullptr);
  return **nested;
}

/// The message that `text` is refused with, without the folder's name.
inline std::string refusal(std::string_view text,
                           const std::map<std::string, std::string>& parameters = {}) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.xml", text);
  return test::input_error_in(folder, [&] { read_document(file, parameters); });
}

}  // namespace pharos::mitsuba
