#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../../shared/nodes.h"
#include "scene_map.h"

namespace pharos::mitsuba {

using importing::number_node, importing::text_node, importing::transform_node,
    importing::triple_node;

/// Returns one number for gray colors, and otherwise a list of three.
ConfigNode color_node(const Spectrum& value, const Location& where);

/// One object during mapping. Returns its properties and records which were requested, so that
/// finish() can note the unused ones. All functions throw InputError if a property is present but
/// has another type.
class Part {
 public:
  Part(SceneMap& map, const Object& object, UvSense sense = UvSense::same)
      : map_(map), object_(object), sense_(sense), is_read_(object.properties.size()) {}

  SceneMap& map() { return map_; }
  const Object& object() const { return object_; }
  const Location& where() const { return object_.where; }
  UvSense sense() const { return sense_; }

  /// Returns a mapping with this `type`, located at the object.
  ConfigNode node(const char* type) const;

  /// Returns the property of this name and marks it as read; null if there is none.
  const Property* take(std::string_view name);
  bool has(std::string_view name) const { return object_.find(name) != nullptr; }
  std::optional<double> number(std::string_view name);
  double number(std::string_view name, double otherwise) {
    return number(name).value_or(otherwise);
  }
  std::optional<std::int64_t> integer(std::string_view name);
  bool flag(std::string_view name, bool otherwise);
  std::optional<std::string> text(std::string_view name);
  std::string text(std::string_view name, const char* otherwise) {
    return text(name).value_or(otherwise);
  }
  std::optional<Spectrum> color(std::string_view name);
  std::optional<Vec3> triple(std::string_view name);
  std::optional<Transform> transform(std::string_view name);
  /// Returns the nested objects of this tag, in order.
  std::vector<const Object*> children(std::string_view tag);
  /// Returns the only nested object of this tag; null if there is none. Adds a note if there are
  /// several.
  const Object* child(std::string_view tag);

  /// Returns the node of a property, or of `otherwise` at the place of the object.
  ConfigNode number_or(std::string_view name, double otherwise);
  ConfigNode color_or(std::string_view name, double otherwise);
  /// Returns a color, or a texture mapped for the part's UvSense.
  ConfigNode texture_or(std::string_view name, double otherwise);
  /// Returns a number, or the average of a texture with a note.
  double average(std::string_view name, double otherwise);
  /// Returns the node of the file name. Throws InputError if `name` is missing.
  ConfigNode file(std::string_view name);
  /// Sets `key` of `node` to the transform, if it is given.
  void copy_transform(ConfigNode& node, const char* key, std::string_view name = "to_world");
  /// Sets `key` of `node` if the property is true.
  void copy_flag(ConfigNode& node, const char* key);

  /// Adds a note at this object.
  void note(const std::string& message) { map_.note(where(), message); }
  /// Marks properties as read that make no difference in Pharos.
  void ignore(std::initializer_list<std::string_view> names);
  /// Reads a property that makes no difference at `value`. Any other value is omitted with a note.
  void expect(std::string_view name, double value);
  /// Notes the properties that were never requested.
  void finish();

 private:
  [[noreturn]] static void fail_kind(const Property& property, const char* expected);

  SceneMap& map_;
  const Object& object_;
  UvSense sense_;
  std::vector<bool> is_read_;
};

/// Returns the entry of `table` for the object's type. Throws InputError with the nearest type if
/// there is none.
template <class Mapper>
const Mapper& mapper_of(const std::map<std::string_view, Mapper>& table, const Object& object);
[[noreturn]] void fail_type_of(const Object& object, const std::vector<std::string>& known);

template <class Mapper>
const Mapper& mapper_of(const std::map<std::string_view, Mapper>& table, const Object& object) {
  const auto found = table.find(object.type);
  if (found != table.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [type, mapper] : table) known.emplace_back(type);
  fail_type_of(object, known);
}

/// Maps an object by `map(part)`. Records it in the list of objects as a `contract` with the type
/// of its node, and notes the unused properties.
template <class Map>
ConfigNode map_part(SceneMap& scene, const Object& object, UvSense sense, const char* contract,
                    const Map& map) {
  SceneMap::Entry entry(scene, object);
  Part part(scene, object, sense);
  ConfigNode node = map(part);
  part.finish();
  const ConfigNode* type = node.find("type");
  if (type != nullptr) entry.done(std::string(contract) + " " + type->text());
  return node;
}

}  // namespace pharos::mitsuba
