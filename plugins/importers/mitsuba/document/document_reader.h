#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "document.h"
#include "element.h"
#include "folders.h"
#include "names.h"
#include "references.h"
#include "variables.h"
#include "xml_file.h"

namespace pharos::mitsuba {

/// Reads one scene with all files that it includes; see read_document().
class DocumentReader {
 public:
  DocumentReader(const std::filesystem::path& file,
                 const std::map<std::string, std::string>& parameters);

  /// Reads the scene. May be called once.
  Document read();

 private:
  /// The context of an element.
  struct Context {
    Dialect dialect;
    std::size_t depth;  ///< levels of elements and includes
  };
  /// An object that is being read.
  struct Parent {
    std::shared_ptr<Object> object;
    std::map<std::string, std::size_t> values = {};  ///< places of its plain values, by name
  };

  void read_children(const XmlFile& file, pugi::xml_node node, Parent& parent, Context context);
  void read_element(const Element& element, Parent& parent, Context context);
  void read_object(const Element& element, Parent& parent, Context context);
  void read_value(const Element& element, Parent& parent, Context context);
  Property::Value value_of(const Element& element, const Object& parent, Dialect dialect);
  void read_reference(const Element& element, Parent& parent, Context context);
  void read_default(const Element& element);
  void read_include(const Element& element, Parent& parent, Context context);
  void read_included(const Element& include, const XmlFile& file, Parent& parent, Context context);
  void note(const Location& where, const std::string& message);

  std::filesystem::path path_;
  Variables variables_;
  Folders folders_;
  importing::ReadingBudget budget_;
  References references_;
  std::vector<std::filesystem::path> open_files_;  ///< canonical, the outermost first
  std::vector<ImportNote> notes_;
};

}  // namespace pharos::mitsuba
