#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// Reads scenes in configs: either the path to a scene file, or the same mapping in place.
///
///     textures:  { name: texture, … }          # named parts, used by name below
///     materials: { name: bsdf, … }
///     media:     { name: medium, … }
///     shapes:    [ { type: …, material: …, emitter: …, interior: …, exterior: … }, … ]
///     groups:    { name: [ as shapes, … ], … }
///     emitters:  [ emitter, … ]                # emitters without a shape
///     sensor:    sensor
///     medium:    medium                        # around the sensor
///
/// A shape without `material` gets the default BSDF. Names are valid within their scene only. A
/// part may use the names of earlier parts. An entry `{ type: instance, group: name, to_world: … }`
/// among `shapes` or in a group places a copy of a whole group. Groups may be used before they are
/// defined, and they have no emitters. Reading throws InputError with the location if parts do not
/// fit together.
template <>
struct Value<SceneParts> : PlainValue {
  static std::string type_name() { return "scene"; }
  static std::string default_text(const SceneParts&) { return {}; }
  static SceneParts read(const ConfigNode& node, BuildContext& context, ConfigNode& resolved);
};

/// Throws InputError at `node` if rays from the sensor to a film of `width` x `height` pixels start
/// too far from the origin.
void check_sensor_reach(const Sensor& sensor, int width, int height, const ConfigNode& node);

}  // namespace pharos
