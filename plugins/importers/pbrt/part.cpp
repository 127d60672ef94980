#include "part.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <pharos/config/values.h>

namespace pharos::pbrt {

ConfigNode number_node(double value, const Location& where) {
  return ConfigNode::scalar(number_text(static_cast<float>(value)), where);
}

ConfigNode color_node(const Color& color, const Location& where) {
  if (color.is_gray) return number_node(double{color.value.r}, where);
  return rgb_node(color.value, where);
}

Part::Part(Scene& scene, const Statement& statement, const std::string& kind)
    : scene_(scene), statement_(statement) {
  for (const Parameter& p : statement.parameters) parameters_.push_back(&p);
  is_read_.resize(parameters_.size());
  if (scene.state().attributes == nullptr) return;
  const auto attributes = scene.state().attributes->find(kind);
  if (attributes == scene.state().attributes->end()) return;
  // Attributes stand for all shapes, lights and so on; a type that has no such parameter ignores
  // them without a note.
  parameters_.insert(parameters_.begin(), attributes->second.size(), nullptr);
  is_read_.insert(is_read_.begin(), attributes->second.size(), true);
  for (std::size_t i = 0; i < attributes->second.size(); ++i) {
    parameters_[i] = &attributes->second[i];
  }
}

std::optional<std::size_t> Part::place_of(std::string_view name) const {
  for (std::size_t i = parameters_.size(); i > 0; --i) {
    if (parameters_[i - 1]->name == name) return i - 1;
  }
  return std::nullopt;
}

const Parameter* Part::find(std::string_view name) const {
  const std::optional<std::size_t> place = place_of(name);
  return place ? parameters_[*place] : nullptr;
}

const Parameter* Part::take(std::string_view name) {
  const std::optional<std::size_t> place = place_of(name);
  if (!place) return nullptr;
  is_read_[*place] = true;
  return parameters_[*place];
}

const Location& Part::where(std::string_view name) const {
  const Parameter* p = find(name);
  return p != nullptr ? p->where : where();
}

void Part::fail_kind(const Parameter& parameter, const char* expected) {
  throw InputError(parameter.where, fmt::format("'{}' must be {}", parameter.name, expected));
}

std::optional<double> Part::number(std::string_view name) {
  const Parameter* p = take(name);
  if (p == nullptr) return std::nullopt;
  const bool is_number = p->type == "float" || p->type == "integer";
  if (!is_number || p->numbers.size() != 1) fail_kind(*p, "one number");
  return p->numbers.front();
}

double Part::positive(std::string_view name, double otherwise) {
  const double value = number(name, otherwise);
  if (!(value > 0)) fail_kind(*find(name), "above 0");
  return value;
}

int Part::integer(std::string_view name, int otherwise) {
  const std::optional<double> value = number(name);
  if (!value) return otherwise;
  if (*value != std::floor(*value) || std::abs(*value) > 1e9) fail_kind(*find(name), "an integer");
  return static_cast<int>(*value);
}

bool Part::flag(std::string_view name, bool otherwise) {
  const Parameter* p = take(name);
  if (p == nullptr) return otherwise;
  if (p->type != "bool" || p->numbers.size() != 1) fail_kind(*p, "true or false");
  return p->numbers.front() != 0;
}

std::optional<std::string> Part::text(std::string_view name) {
  const Parameter* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (p->type != "string" || p->texts.size() != 1) fail_kind(*p, "a text");
  return p->texts.front();
}

std::optional<Vec3> Part::point(std::string_view name) {
  const Parameter* p = take(name);
  if (p == nullptr) return std::nullopt;
  const bool is_triple = p->type == "point3" || p->type == "vector3";
  if (!is_triple || p->numbers.size() != 3) fail_kind(*p, "a point or vector");
  const auto at = [&](std::size_t i) { return static_cast<float>(p->numbers[i]); };
  return Vec3{at(0), at(1), at(2)};
}

std::vector<double> Part::numbers(std::string_view name, std::size_t count) {
  const Parameter* p = take(name);
  if (p == nullptr) return {};
  const bool is_number = p->type == "float" || p->type == "integer";
  if (!is_number || p->numbers.size() != count) {
    fail_kind(*p, fmt::format("{} numbers", count).c_str());
  }
  return p->numbers;
}

std::optional<Color> Part::color(std::string_view name, ColorRole role) {
  const Parameter* p = take(name);
  if (p == nullptr) return std::nullopt;
  const Color color = scene_.color(*p, role);
  if (color.approximated) {
    scene_.note(p->where, fmt::format("{} {}: the spectrum of '{}' is brought to RGB",
                                      statement_.word, statement_.type(), name));
  }
  return color;
}

ConfigNode Part::texture_or(std::string_view name, double otherwise, double most,
                            TextureKind kind) {
  const Parameter* p = find(name);
  if (p == nullptr) return number_node(otherwise, where());
  if (p->type == "texture") {
    take(name);
    return text_node(scene_.texture(*p, kind).name, p->where);
  }
  Color stated = *color(name, ColorRole::surface);
  for (int c = 0; c < 3; ++c) {
    float& channel = stated.value[c];
    const float limited = std::clamp(channel, 0.0f, static_cast<float>(most));
    if (limited != channel) {
      note(fmt::format("'{}' is limited to the range from 0 to {}", name, most));
    }
    channel = limited;
  }
  return color_node(stated, p->where);
}

double Part::average(std::string_view name, double otherwise) {
  const Parameter* p = find(name);
  if (p == nullptr || p->type != "texture") return number(name, otherwise);
  take(name);
  const std::optional<double> mean = scene_.texture(*p, TextureKind::number).average();
  note(fmt::format("the texture of '{}' is replaced by {}", name,
                   mean ? "its average" : "the default " + number_text(otherwise)));
  return mean.value_or(otherwise);
}

ConfigNode Part::file(std::string_view name) {
  const std::optional<std::string> stated = text(name);
  if (!stated || stated->empty()) {
    throw InputError(where(), fmt::format("{} {}: '{}' is missing", statement_.word,
                                          one_line(statement_.type(), 60), name));
  }
  return scene_.file_node(*stated, where(name));
}

void Part::note(const std::string& message) {
  scene_.note(where(), fmt::format("{} {}: {}", statement_.word,
                                   one_line(statement_.texts.back(), 60), message));
}

void Part::ignore(std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) take(name);
}

void Part::ignore_all() {
  std::fill(is_read_.begin(), is_read_.end(), true);
}

void Part::finish() {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (is_read_[i]) continue;
    scene_.note(parameters_[i]->where, fmt::format("{} {}: '{}' is left out", statement_.word,
                                                   one_line(statement_.texts.back(), 60),
                                                   one_line(parameters_[i]->name, 60)));
  }
}

}  // namespace pharos::pbrt
