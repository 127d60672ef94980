#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/rendering/render_config.h>

#include "../mapping/mapping.h"

/// Scenes of Mitsuba made by hand, and what becomes of them.
namespace pharos::mitsuba::test {

using ObjectRef = std::shared_ptr<const Object>;

/// A property in line `line` of scene.xml.
Property value(std::string name, Property::Value v, int line = 1);
Spectrum rgb(float r, float g, float b);
Property nested(ObjectRef object, std::string name = {});

/// An object in line `line` of scene.xml.
ObjectRef object(std::string tag, std::string type, std::vector<Property> properties = {},
                 std::string id = {}, int line = 1);
ObjectRef bsdf(std::string type, std::vector<Property> properties = {}, std::string id = {});
ObjectRef shape(std::string type, std::vector<Property> properties = {});
ObjectRef texture(std::string type, std::vector<Property> properties = {}, std::string id = {});
ObjectRef emitter(std::string type, std::vector<Property> properties = {});

/// The import of a scene that holds these.
Import import_of(const std::vector<ObjectRef>& contents, Dialect dialect = Dialect::mitsuba_2);
/// That of a rectangle of this bsdf.
Import import_of_bsdf(const ObjectRef& material, Dialect dialect = Dialect::mitsuba_2);

/// The YAML, on one line, of the part of the config at `path`, such as "scene.shapes.0"; "none"
/// when there is none.
std::string part(const Import& import, const std::string& path);
std::string material_of(const ObjectRef& material, Dialect dialect = Dialect::mitsuba_2);

/// The messages of the notes, in order.
std::vector<std::string> notes(const Import& import);

/// The config with the plugins of the build; a camera is added where there is none.
LoadedConfig built(Import import);

}  // namespace pharos::mitsuba::test
