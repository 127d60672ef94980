// The changes from Mitsuba 0.3 to 0.4, as in the style sheet with which Mitsuba 0.4 to 0.6 upgrade
// scenes (data/schema/upgrade_0.4.0.xsl of its sources).
#include "upgrade.h"

#include <algorithm>
#include <string>
#include <utility>

#include <pharos/core/transform.h>

namespace pharos::mitsuba {
namespace {

Property* find(Object& object, std::string_view name) {
  const auto found = std::find_if(object.properties.begin(), object.properties.end(),
                                  [&](const Property& p) { return p.name == name; });
  return found == object.properties.end() ? nullptr : &*found;
}

/// Returns the property of this name; creates it with `value` if there is none.
Property& find_or_add(Object& object, const std::string& name, Property::Value value) {
  Property* const found = find(object, name);
  if (found != nullptr) return *found;
  return object.properties.emplace_back(Property{name, object.where, std::move(value)});
}

void upgrade_luminaire(Object& object) {
  Property* const intensity = find(object, "intensity");
  if (intensity == nullptr) return;
  if (object.type == "area" || object.type == "constant") intensity->name = "radiance";
  if (object.type == "directional") intensity->name = "irradiance";
}

void upgrade_camera(Object& object) {
  Property& to_world = find_or_add(object, "to_world", Transform());
  if (auto* const transform = std::get_if<Transform>(&to_world.value)) {
    *transform = *transform * Transform::scale({-1, 1, 1});
  }
  if (object.type != "perspective") return;
  const Property* const smaller = object.find("map_smaller_side");
  const bool* const is_smaller = smaller == nullptr ? nullptr : std::get_if<bool>(&smaller->value);
  const std::string axis = is_smaller != nullptr && !*is_smaller ? "larger" : "smaller";
  std::erase_if(object.properties, [](const Property& p) { return p.name == "map_smaller_side"; });
  find_or_add(object, "fov_axis", axis);
}

}  // namespace

void upgrade(Object& object, std::string_view written_tag) {
  if (written_tag == "luminaire") upgrade_luminaire(object);
  if (written_tag == "camera") upgrade_camera(object);
}

}  // namespace pharos::mitsuba
