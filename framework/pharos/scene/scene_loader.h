#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// Scenes in configs: a path to a scene file, or the same mapping in place.
///
///     textures:  { name: texture, … }          # named parts, used by name below
///     materials: { name: bsdf, … }
///     media:     { name: medium, … }
///     shapes:    [ { type: …, material: …, emitter: …, interior: …, exterior: … }, … ]
///     groups:    { name: [ as shapes, … ], … }
///     emitters:  [ emitter, … ]                # those without shape
///     sensor:    sensor
///     medium:    medium                        # around the sensor
///
/// Shapes without `material` get the default bsdf. Names are known within their scene only; a later
/// part may use an earlier one's. An entry `{ type: instance, group: name, to_world: … }` among
/// `shapes` or in a group shows all of a group once more. Groups may be used before they are
/// defined; they have no emitters. Reading throws InputError with the location for everything that
/// does not fit together.
template <>
struct Value<SceneParts> : PlainValue {
  static std::string type_name() { return "scene"; }
  static std::string default_text(const SceneParts&) { return {}; }
  static SceneParts read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved);
};

}  // namespace pharos
