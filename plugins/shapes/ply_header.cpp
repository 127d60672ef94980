#include "ply_header.h"

#include <array>
#include <charconv>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/core.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

struct TypeName {
  std::string_view old_name, new_name;
  PlyType type;
  std::size_t size;
};
constexpr std::array<TypeName, 8> kTypes{{{"char", "int8", PlyType::int8, 1},
                                          {"uchar", "uint8", PlyType::uint8, 1},
                                          {"short", "int16", PlyType::int16, 2},
                                          {"ushort", "uint16", PlyType::uint16, 2},
                                          {"int", "int32", PlyType::int32, 4},
                                          {"uint", "uint32", PlyType::uint32, 4},
                                          {"float", "float32", PlyType::float32, 4},
                                          {"double", "float64", PlyType::float64, 8}}};

/// Parses the header line by line.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : text_(text) {}

  PlyHeader parse() {
    if (next_line() != "ply") throw InputError("it does not begin with a line 'ply'");
    bool has_format = false;
    for (std::string line = next_line(); line != "end_header"; line = next_line()) {
      std::istringstream words(line);
      std::string keyword;
      words >> keyword;
      if (keyword == "format") {
        header_.format = format(words);
        has_format = true;
      } else if (keyword == "element") {
        header_.elements.push_back(element(words));
      } else if (keyword == "property") {
        if (header_.elements.empty()) fail("belongs to no element");
        add(property(words), header_.elements.back());
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        fail("is unknown");
      }
    }
    if (!has_format) throw InputError("its header names no format");
    header_.size = at_;
    return std::move(header_);
  }

 private:
  std::string next_line() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) throw InputError("it ends within the header");
    line_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_number_;
    line_.erase(line_.find_last_not_of(" \t\r") + 1);
    return line_;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        fmt::format("line {} of its header, '{}', {}", line_number_, one_line(line_, 60), what));
  }

  PlyFormat format(std::istringstream& words) const {
    std::string name, version;
    words >> name >> version;
    if (version != "1.0") fail("names no known version: known is 1.0");
    if (name == "ascii") return PlyFormat::ascii;
    if (name == "binary_little_endian") return PlyFormat::little_endian;
    if (name == "binary_big_endian") return PlyFormat::big_endian;
    fail("names no known format");
  }

  PlyElement element(std::istringstream& words) {
    PlyElement element;
    std::string count;
    words >> element.name >> count;
    if (!names_.insert(element.name).second) fail("names an element for the second time");
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc{} || end != count.data() + count.size()) fail("has no valid count");
    return element;
  }

  PlyProperty property(std::istringstream& words) const {
    PlyProperty property;
    std::string first;
    words >> first;
    if (first == "list") {
      std::string count;
      words >> count >> first;
      property.count_type = type(count);
    }
    property.type = type(first);
    words >> property.name;
    return property;
  }

  void add(PlyProperty property, PlyElement& element) const {
    for (const PlyProperty& other : element.properties) {
      if (other.name == property.name) fail("names a property for the second time");
    }
    element.properties.push_back(std::move(property));
  }

  PlyType type(const std::string& name) const {
    for (const TypeName& known : kTypes) {
      if (name == known.old_name || name == known.new_name) return known.type;
    }
    fail("names no known type");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string line_;
  int line_number_ = 0;
  PlyHeader header_;
  std::set<std::string> names_;  ///< names of the elements so far
};

}  // namespace

std::size_t size_of(PlyType type) {
  return kTypes[static_cast<std::size_t>(type)].size;
}

PlyHeader read_ply_header(std::string_view text) {
  return HeaderParser(text).parse();
}

}  // namespace pharos
