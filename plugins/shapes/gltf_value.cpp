#include "gltf_value.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <pharos/core/error.h>

namespace pharos {
namespace {

using nlohmann::json;

/// Returns the parser's reason without its own name and its own description of the place.
std::string reason_of(const json::exception& e) {
  const std::string_view what = e.what();
  const std::size_t syntax = what.find("syntax error");
  const std::size_t at = syntax != std::string_view::npos ? syntax : what.find("] ") + 2;
  return one_line(what.substr(std::min(at, what.size())), 200);
}

Location location_of(std::string_view text, std::size_t at, const std::string& file) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return {file, static_cast<int>(1 + std::count(before.begin(), before.end(), '\n')),
          static_cast<int>(1 + before.size() - line_begin)};
}

std::shared_ptr<const json> parse(std::string_view text, const std::string& file) {
  try {
    return std::make_shared<const json>(json::parse(text));
  } catch (const json::parse_error& e) {
    const std::size_t at = e.byte > 0 ? e.byte - 1 : 0;
    if (file.empty()) throw InputError(fmt::format("byte {} of its JSON: {}", at, reason_of(e)));
    throw InputError(location_of(text, at, file), reason_of(e));
  } catch (const json::exception& e) {
    throw InputError("its JSON: " + reason_of(e));
  }
}

}  // namespace

void GltfValue::fail(const std::string& what) const {
  throw InputError((place_.empty() ? "its JSON" : place_) + " " + what);
}

bool GltfValue::has(const char* key) const {
  return json_->is_object() && json_->contains(key);
}

GltfValue GltfValue::member(const char* key) const {
  if (!json_->is_object()) fail("is no object");
  const auto found = json_->find(key);
  if (found == json_->end()) fail(fmt::format("has no '{}'", key));
  return {*found, place_.empty() ? key : place_ + "." + key};
}

std::size_t GltfValue::size() const {
  if (!json_->is_array()) fail("is no list");
  return json_->size();
}

GltfValue GltfValue::item(std::size_t index) const {
  if (index >= size()) fail(fmt::format("has no item {}; it has {}", index, size()));
  return {(*json_)[index], fmt::format("{}[{}]", place_, index)};
}

double GltfValue::number() const {
  if (!json_->is_number()) fail("is no number");
  return json_->get<double>();
}

std::uint64_t GltfValue::whole() const {
  if (json_->is_number_unsigned()) return json_->get<std::uint64_t>();
  const double value = number();  // 3.0 is a whole number as well
  if (!(value >= 0 && value <= 0x1p53 && value == std::floor(value))) {
    fail("is no whole number from 0 on");
  }
  return static_cast<std::uint64_t>(value);
}

bool GltfValue::truth() const {
  if (!json_->is_boolean()) fail("is neither true nor false");
  return json_->get<bool>();
}

const std::string& GltfValue::text() const {
  if (!json_->is_string()) fail("is no text");
  return json_->get_ref<const std::string&>();
}

std::uint64_t GltfValue::whole(const char* key, std::uint64_t otherwise) const {
  return has(key) ? member(key).whole() : otherwise;
}

bool GltfValue::truth(const char* key, bool otherwise) const {
  return has(key) ? member(key).truth() : otherwise;
}

std::string GltfValue::text(const char* key, const std::string& otherwise) const {
  return has(key) ? member(key).text() : otherwise;
}

GltfDocument::GltfDocument(std::string_view text, const std::string& file)
    : json_(parse(text, file)) {}

GltfValue GltfDocument::referenced(const GltfValue& reference, const char* key) const {
  const std::uint64_t index = reference.whole();
  const GltfValue list = root().member(key);
  if (index >= list.size()) {
    reference.fail(fmt::format("names item {} of {}, which has {}", index, key, list.size()));
  }
  return list.item(index);
}

}  // namespace pharos
