#include "element.h"

#include <algorithm>

#include <fmt/format.h>

namespace pharos::mitsuba {
namespace {

constexpr std::size_t kMostAttributes = 32;
constexpr std::size_t kMostBytes = std::size_t{1} << 20;

}  // namespace

Element::Element(const XmlFile& file, pugi::xml_node node, Variables& variables)
    : file_(file), node_(node) {
  for (const pugi::xml_attribute attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    if (attributes_.size() == kMostAttributes) {
      fail(name, fmt::format("expected at most {} attributes", kMostAttributes));
    }
    if (std::string_view(attribute.value()).size() > kMostBytes) {
      fail(name, "expected at most 1 MiB of text in an attribute");
    }
    if (has(name)) fail(fmt::format("the attribute '{}' is there twice", one_line(name, 60)));
    try {
      attributes_.emplace_back(name, variables.replace_in(attribute.value()));
    } catch (const InputError& e) {
      fail(name, e.what());
    }
  }
}

void Element::expect(std::initializer_list<std::string_view> needed,
                     std::initializer_list<std::string_view> optional) const {
  std::vector<std::string> known(needed.begin(), needed.end());
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& [name, value] : attributes_) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::erase_if(known, [&](const std::string& other) { return has(other); });
    fail(name, fmt::format("<{}> has no attribute '{}'{}", tag(), one_line(name, 60),
                           suggestion(name, known)));
  }
  for (const std::string_view name : needed) {
    if (!has(name)) fail(fmt::format("<{}> needs the attribute '{}'", tag(), name));
  }
}

void Element::expect_empty() const {
  const std::vector<pugi::xml_node> inside = file_.elements_in(node_);
  if (inside.empty()) return;
  throw InputError(file_.where(inside.front()),
                   fmt::format("nothing may stand in a <{}>, found <{}>", tag(),
                               one_line(inside.front().name(), 60)));
}

const std::string& Element::text(std::string_view attribute) const {
  static const std::string none;
  const std::string* const value = find(attribute);
  return value == nullptr ? none : *value;
}

std::vector<Element> Element::children(Variables& variables) const {
  std::vector<Element> all;
  for (const pugi::xml_node node : file_.elements_in(node_)) {
    all.emplace_back(file_, node, variables);
  }
  return all;
}

const std::string* Element::find(std::string_view attribute) const {
  const auto found = std::find_if(attributes_.begin(), attributes_.end(),
                                  [&](const auto& entry) { return entry.first == attribute; });
  return found == attributes_.end() ? nullptr : &found->second;
}

void Element::fail(const std::string& message) const {
  throw InputError(where(), message);
}

void Element::fail(std::string_view attribute, const std::string& message) const {
  throw InputError(file_.where(node_, attribute), message);
}

void Element::fail_value(std::string_view attribute, std::string_view what) const {
  fail(attribute, fmt::format("expected {}, found '{}'", what, one_line(text(attribute), 40)));
}

}  // namespace pharos::mitsuba
