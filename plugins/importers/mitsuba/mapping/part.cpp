#include "part.h"

#include <cmath>

#include <fmt/core.h>

#include <pharos/config/values.h>

#include "textures.h"

namespace pharos::mitsuba {
namespace {

const Object* nested_object(const Property& property) {
  const auto* nested = std::get_if<std::shared_ptr<const Object>>(&property.value);
  return nested != nullptr ? nested->get() : nullptr;
}

}  // namespace

ConfigNode color_node(const Spectrum& value, const Location& where) {
  if (value.is_gray) return ConfigNode::scalar(number_text(value.value.r), where);
  return importing::rgb_node(value.value, where);
}

ConfigNode Part::node(const char* type) const {
  return importing::plugin_node(type, where());
}

void Part::fail_kind(const Property& property, const char* expected) {
  throw InputError(property.where, fmt::format("'{}' must be {}", property.name, expected));
}

const Property* Part::take(std::string_view name) {
  for (std::size_t i = 0; i < object_.properties.size(); ++i) {
    if (object_.properties[i].name != name) continue;
    is_read_[i] = true;
    return &object_.properties[i];
  }
  return nullptr;
}

std::optional<double> Part::number(std::string_view name) {
  const Property* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (const auto* x = std::get_if<double>(&p->value)) return *x;
  if (const auto* i = std::get_if<std::int64_t>(&p->value)) return static_cast<double>(*i);
  if (const auto* s = std::get_if<Spectrum>(&p->value); s != nullptr && s->is_gray) {
    return s->value.r;
  }
  fail_kind(*p, "a number");
}

std::optional<std::int64_t> Part::integer(std::string_view name) {
  const Property* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (const auto* i = std::get_if<std::int64_t>(&p->value)) return *i;
  const auto* x = std::get_if<double>(&p->value);
  if (x != nullptr && std::abs(*x) < 1e15 && *x == std::floor(*x)) {
    return static_cast<std::int64_t>(*x);
  }
  fail_kind(*p, "an integer");
}

bool Part::flag(std::string_view name, bool otherwise) {
  const Property* p = take(name);
  if (p == nullptr) return otherwise;
  if (const auto* b = std::get_if<bool>(&p->value)) return *b;
  fail_kind(*p, "true or false");
}

std::optional<std::string> Part::text(std::string_view name) {
  const Property* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (const auto* s = std::get_if<std::string>(&p->value)) return *s;
  fail_kind(*p, "a text");
}

std::optional<Spectrum> Part::color(std::string_view name) {
  const Property* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (const auto* s = std::get_if<Spectrum>(&p->value)) {
    if (s->approximated) {
      map_.note(p->where, fmt::format("{} {}: the spectrum of '{}' is brought to RGB", object_.tag,
                                      object_.type, name));
    }
    return *s;
  }
  if (nested_object(*p) != nullptr) fail_kind(*p, "a color");
  const std::optional<double> gray = number(name);
  return Spectrum{.value = Rgb(static_cast<float>(*gray)), .is_gray = true};
}

std::optional<Vec3> Part::triple(std::string_view name) {
  const Property* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (const auto* t = std::get_if<Triple>(&p->value)) return t->value;
  fail_kind(*p, "a point or vector");
}

std::optional<Transform> Part::transform(std::string_view name) {
  const Property* p = take(name);
  if (p == nullptr) return std::nullopt;
  if (const auto* t = std::get_if<Transform>(&p->value)) return *t;
  fail_kind(*p, "a transform");
}

std::vector<const Object*> Part::children(std::string_view tag) {
  std::vector<const Object*> all;
  for (std::size_t i = 0; i < object_.properties.size(); ++i) {
    const Object* nested = nested_object(object_.properties[i]);
    if (nested == nullptr || nested->tag != tag) continue;
    is_read_[i] = true;
    all.push_back(nested);
  }
  return all;
}

const Object* Part::child(std::string_view tag) {
  const std::vector<const Object*> all = children(tag);
  if (all.empty()) return nullptr;
  if (all.size() > 1) {
    note(fmt::format("{} {}: of several objects '{}' in it the first is used", object_.tag,
                     object_.type, tag));
  }
  return all.front();
}

ConfigNode Part::number_or(std::string_view name, double otherwise) {
  const Property* p = object_.find(name);
  return number_node(number(name, otherwise), p != nullptr ? p->where : where());
}

ConfigNode Part::color_or(std::string_view name, double otherwise) {
  const std::optional<Spectrum> stated = color(name);
  return stated ? color_node(*stated, object_.find(name)->where) : number_node(otherwise, where());
}

ConfigNode Part::texture_or(std::string_view name, double otherwise) {
  const Property* p = object_.find(name);
  const Object* nested = p != nullptr ? nested_object(*p) : nullptr;
  if (nested == nullptr) return color_or(name, otherwise);
  take(name);
  if (nested->tag != "texture") fail_kind(*p, "a texture or a color");
  return map_texture(map_, *nested, sense_, p->where);
}

double Part::average(std::string_view name, double otherwise) {
  const Property* p = object_.find(name);
  const Object* nested = p != nullptr ? nested_object(*p) : nullptr;
  if (nested == nullptr) return number(name, otherwise);
  take(name);
  const std::optional<Rgb> mean_color = texture_average(map_, *nested);
  const double value = mean_color ? double{mean(*mean_color)} : otherwise;
  note(fmt::format("{} {}: the texture of '{}' is replaced by {}", object_.tag, object_.type, name,
                   mean_color ? "its average" : "the default " + number_text(otherwise)));
  return value;
}

ConfigNode Part::file(std::string_view name) {
  const std::optional<std::string> stated = text(name);
  if (!stated || stated->empty()) {
    throw InputError(where(), fmt::format("{}: '{}' is missing", describe(object_), name));
  }
  return map_.file_node(*stated, object_.find(name)->where);
}

void Part::copy_transform(ConfigNode& node, const char* key, std::string_view name) {
  const std::optional<Transform> stated = transform(name);
  if (!stated || stated->matrix() == Transform().matrix()) return;
  const Location& there = object_.find(name)->where;
  node.set(key, transform_node(*stated, there), there);
}

void Part::copy_flag(ConfigNode& node, const char* key) {
  if (!flag(key, false)) return;
  const Location& there = object_.find(key)->where;
  node.set(key, text_node("true", there), there);
}

void Part::ignore(std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) take(name);
}

void Part::expect(std::string_view name, double value) {
  const std::optional<double> stated = number(name);
  if (!stated || std::abs(*stated - value) <= 1e-6 * std::max(1.0, std::abs(value))) return;
  map_.note(object_.find(name)->where,
            fmt::format("{} {}: '{}' is left out", object_.tag, object_.type, name));
}

void Part::finish() {
  for (std::size_t i = 0; i < object_.properties.size(); ++i) {
    if (is_read_[i]) continue;
    const Property& p = object_.properties[i];
    const Object* nested = nested_object(p);
    const std::string what = p.name.empty() && nested != nullptr
                                 ? fmt::format("the {} '{}' in it", nested->tag, nested->type)
                                 : "'" + p.name + "'";
    map_.note(p.where, fmt::format("{} {}: {} is left out", object_.tag, object_.type, what));
  }
}

void fail_type_of(const Object& object, const std::vector<std::string>& known) {
  throw InputError(object.where, fmt::format("unknown {} '{}'{}; known: {}", object.tag,
                                             one_line(object.type, 60),
                                             suggestion(object.type, known), quoted_list(known)));
}

}  // namespace pharos::mitsuba
