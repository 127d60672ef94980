#pragma once

#include <map>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../mitsuba/document/document.h"

namespace pharos::mitsuba {

/// Reads `text` as the file scene.xml in a new folder.
inline Document read_text(std::string_view text,
                          const std::map<std::string, std::string>& parameters = {}) {
  const test::TemporaryFolder folder;
  return read_document(folder.write("scene.xml", text), parameters);
}

/// Reads the content of a scene in dialect 0.x or 2/3.
inline Document read_old(const std::string& inside) {
  return read_text("<scene version=\"0.6.0\">" + inside + "</scene>");
}
inline Document read_new(const std::string& inside) {
  return read_text("<scene version=\"3.0.0\">" + inside + "</scene>");
}

/// Returns the value of the property `name`, or of a property without a name.
template <class T>
T value(const Object& object, std::string_view name = "") {
  const Property* const property = object.find(name);
  REQUIRE(property != nullptr);
  REQUIRE(std::holds_alternative<T>(property->value));
  return std::get<T>(property->value);
}

/// Returns the object in the property `name`, or in the first property without a name.
inline const Object& child(const Object& object, std::string_view name = "") {
  const Property* const property = object.find(name);
  REQUIRE(property != nullptr);
  const auto* const nested = std::get_if<std::shared_ptr<const Object>>(&property->value);
  REQUIRE(nested != nullptr);
  return **nested;
}

/// Returns the error message for `text`, without the name of the folder.
inline std::string refusal(std::string_view text,
                           const std::map<std::string, std::string>& parameters = {}) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.xml", text);
  return pharos::test::input_error_in(folder, [&] { read_document(file, parameters); });
}

}  // namespace pharos::mitsuba
