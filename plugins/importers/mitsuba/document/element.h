#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/core/error.h>

#include "variables.h"
#include "xml_file.h"

namespace pharos::mitsuba {

/// An element of a scene file, with its variables replaced.
class Element {
 public:
  /// Throws InputError for an attribute that occurs twice, more than 32 attributes, values of more
  /// than 1 MiB, and unknown variables.
  Element(const XmlFile& file, pugi::xml_node node, Variables& variables);

  std::string_view tag() const { return node_.name(); }
  Location where() const { return file_.where(node_); }

  /// Throws InputError unless all `needed` attributes are present and all others are `optional`.
  void expect(std::initializer_list<std::string_view> needed,
              std::initializer_list<std::string_view> optional = {}) const;
  /// Throws InputError if the element has any content.
  void expect_empty() const;

  bool has(std::string_view attribute) const { return find(attribute) != nullptr; }
  /// Returns the value of an attribute; empty if it is missing.
  const std::string& text(std::string_view attribute) const;
  /// Returns all elements inside this element.
  std::vector<Element> children(Variables& variables) const;

  /// Throws InputError, located at the element.
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws InputError, located at the value of an attribute.
  [[noreturn]] void fail(std::string_view attribute, const std::string& message) const;
  /// Throws InputError: "expected WHAT, found 'VALUE'", located at the value of an attribute.
  [[noreturn]] void fail_value(std::string_view attribute, std::string_view what) const;

  const XmlFile& file() const { return file_; }
  pugi::xml_node node() const { return node_; }

 private:
  const std::string* find(std::string_view attribute) const;

  const XmlFile& file_;
  pugi::xml_node node_;
  std::vector<std::pair<std::string_view, std::string>> attributes_;
};

}  // namespace pharos::mitsuba
