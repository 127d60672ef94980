#include "xml_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "utf8.h"

namespace pharos::mitsuba {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Describes the error in terms of the file's syntax.
std::string_view reason(pugi::xml_parse_status status) {
  switch (status) {
    case pugi::status_bad_pi:
      return "expected the end '?>' of what '<?' begins";
    case pugi::status_bad_comment:
      return "expected the end '-->' of a comment";
    case pugi::status_bad_cdata:
      return "expected the end ']]>' of a CDATA section";
    case pugi::status_bad_doctype:
      return "document types (<!DOCTYPE …>) are not read";
    case pugi::status_bad_start_element:
      return "expected a tag such as <shape type=\"sphere\">";
    case pugi::status_bad_attribute:
      return "expected an attribute such as name=\"radius\"";
    case pugi::status_bad_end_element:
      return "expected an end tag such as </shape>";
    case pugi::status_end_element_mismatch:
      return "expected the end tag of the element that was begun last";
    default:
      return "expected well-formed XML";
  }
}

/// Returns the position after the next `end`, or the end of the text.
std::size_t behind(std::string_view text, std::size_t from, std::string_view end) {
  const std::size_t found = text.find(end, from);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

}  // namespace

XmlFile::XmlFile(const std::filesystem::path& path, importing::ReadingBudget& budget)
    : path_(path), text_(importing::read_file(path, budget)) {
  check_encoding();
  find_lines();
  count_parts(budget);
  parse();
  find_root();
}

void XmlFile::check_encoding() const {
  const bool is_utf16 = text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff");
  if (is_utf16) throw InputError(Location{path_.string()}, "expected UTF-8, found UTF-16");
}

void XmlFile::find_lines() {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
  line_begins_ = {0};
  for (std::size_t i = 0; (i = text_.find('\n', i)) != std::string::npos;) {
    line_begins_.push_back(++i);
  }
  const std::size_t bad = first_bad_byte(text_);
  if (bad != std::string_view::npos) {
    fail(bad, fmt::format("expected UTF-8, found the byte 0x{:02x}",
                          static_cast<unsigned char>(text_[bad])));
  }
}

// Counts the parts before the tree is built, because a tree takes many times the memory of its
// text.
void XmlFile::count_parts(importing::ReadingBudget& budget) const {
  const std::string_view text = text_;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '=') {
      if (budget.attributes-- == 0) fail(i, "expected at most eight million attributes");
    } else if (text.substr(i, 4) == "<!--") {
      i = behind(text, i + 4, "-->") - 1;
    } else if (text[i] == '<' && text.substr(i, 2) != "</") {
      if (budget.elements-- == 0) fail(i, "expected at most a million elements");
    }
  }
}

void XmlFile::parse() {
  constexpr unsigned flags = pugi::parse_default | pugi::parse_doctype | pugi::parse_fragment;
  const pugi::xml_parse_result result =
      document_.load_buffer(text_.data(), text_.size(), flags, pugi::encoding_utf8);
  if (!result) {
    fail(std::min(static_cast<std::size_t>(result.offset), text_.size()),
         std::string(reason(result.status)));
  }
}

void XmlFile::find_root() {
  for (const pugi::xml_node node : document_.children()) {
    if (node.type() == pugi::node_doctype) {
      throw InputError(where(node), std::string(reason(pugi::status_bad_doctype)));
    }
    if (node.type() != pugi::node_element) {
      throw InputError(where(node), "expected a tag, found text");
    }
    if (root_) throw InputError(where(node), "expected one outermost element, found a second one");
    root_ = node;
  }
  if (!root_) fail(text_.size(), "expected <scene version=\"…\">, found the end of the file");
}

std::vector<pugi::xml_node> XmlFile::elements_in(pugi::xml_node element) const {
  std::vector<pugi::xml_node> elements;
  for (const pugi::xml_node node : element.children()) {
    if (node.type() != pugi::node_element) {
      throw InputError(where(node), "expected a tag, found text");
    }
    elements.push_back(node);
  }
  return elements;
}

Location XmlFile::where(pugi::xml_node node) const {
  const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
  return where(node.type() == pugi::node_element && offset > 0 ? offset - 1 : offset);
}

// The text was parsed before, so a name followed by attributes with quoted values begins here.
Location XmlFile::where(pugi::xml_node element, std::string_view attribute) const {
  const std::string_view text = text_;
  std::size_t at = static_cast<std::size_t>(element.offset_debug());
  at = text.find_first_of(" \t\r\n/>", at);
  while (at < text.size() && (at = text.find_first_not_of(kBlanks, at)) < text.size()) {
    if (text[at] == '/' || text[at] == '>') break;
    const std::size_t name_end = text.find_first_of(" \t\r\n=", at);
    const std::size_t quote = text.find_first_of("\"'", at);
    if (name_end >= text.size() || quote >= text.size()) break;
    if (text.substr(at, name_end - at) == attribute) return where(quote + 1);
    at = behind(text, quote + 1, text.substr(quote, 1));
  }
  return where(element);
}

Location XmlFile::where(std::size_t offset) const {
  const auto next = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
  const auto line = static_cast<int>(next - line_begins_.begin());
  return {path_.string(), line, static_cast<int>(offset - next[-1]) + 1};
}

void XmlFile::fail(std::size_t offset, const std::string& message) const {
  throw InputError(where(offset), message);
}

}  // namespace pharos::mitsuba
