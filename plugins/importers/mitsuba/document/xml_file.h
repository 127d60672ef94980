#pragma once

#include <cstddef>
#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <pharos/core/error.h>

#include "../../shared/read_file.h"

namespace pharos::mitsuba {

/// A file of well-formed XML with one outermost element, together with the location of every part.
/// Columns count bytes.
class XmlFile {
 public:
  /// Throws InputError if the file is not XML in UTF-8, has a document type, or exceeds the budget.
  /// `path` must be a readable file, see file_problem().
  XmlFile(const std::filesystem::path& path, importing::ReadingBudget& budget);

  const std::filesystem::path& path() const { return path_; }
  /// The outermost element.
  pugi::xml_node root() const { return root_; }
  /// Returns the elements inside an element. Throws InputError if there is text among them.
  std::vector<pugi::xml_node> elements_in(pugi::xml_node element) const;

  /// Returns the location where an element or text begins.
  Location where(pugi::xml_node node) const;
  /// Returns the location where the value of an element's attribute begins.
  Location where(pugi::xml_node element, std::string_view attribute) const;

 private:
  void check_encoding() const;
  void count_parts(importing::ReadingBudget& budget) const;
  void find_lines();
  void parse();
  void find_root();
  Location where(std::size_t offset) const;
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;

  std::filesystem::path path_;
  std::string text_;  ///< without a byte order mark
  std::vector<std::size_t> line_begins_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace pharos::mitsuba
