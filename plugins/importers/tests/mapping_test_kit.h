#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/rendering/render_config.h>

#include "../mitsuba/mapping/mapping.h"

/// Mitsuba scenes built by hand, and the results of their import.
namespace pharos::mitsuba::test {

using ObjectRef = std::shared_ptr<const Object>;

/// Returns a property in line `line` of scene.xml.
Property value(std::string name, Property::Value v, int line = 1);
Spectrum rgb(float r, float g, float b);
Property nested(ObjectRef object, std::string name = {});

/// Returns an object in line `line` of scene.xml.
ObjectRef object(std::string tag, std::string type, std::vector<Property> properties = {},
                 std::string id = {}, int line = 1);
ObjectRef bsdf(std::string type, std::vector<Property> properties = {}, std::string id = {});
ObjectRef shape(std::string type, std::vector<Property> properties = {});
ObjectRef texture(std::string type, std::vector<Property> properties = {}, std::string id = {});
ObjectRef emitter(std::string type, std::vector<Property> properties = {});

/// Returns the import of a scene that contains these objects.
Import import_of(const std::vector<ObjectRef>& contents, Dialect dialect = Dialect::mitsuba_2);
/// Returns the import of a rectangle with this bsdf.
Import import_of_bsdf(const ObjectRef& material, Dialect dialect = Dialect::mitsuba_2);

/// Returns the YAML, on one line, of the part of the config at `path`, such as "scene.shapes.0";
/// "none" if there is no such part.
std::string part(const Import& import, const std::string& path);
std::string material_of(const ObjectRef& material, Dialect dialect = Dialect::mitsuba_2);

/// Returns the messages of the notes, in order.
std::vector<std::string> notes(const Import& import);

/// Returns the config with the plugins of the build. A camera is added if there is none.
LoadedConfig built(Import import);

}  // namespace pharos::mitsuba::test
