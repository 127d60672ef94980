#include "mapping_test_kit.h"

#include <sstream>

#include <pharos/config/module_loader.h>

namespace pharos::mitsuba::test {
namespace {

const Registry& registry() {
  static const Registry all = [] {
    Registry made;
    load_modules(made, PHAROS_PLUGINS, true);
    return made;
  }();
  return all;
}

const ConfigNode* step_into(const ConfigNode& node, const std::string& key) {
  if (!node.is_sequence()) return node.find(key);
  const std::size_t index = std::stoul(key);
  return index < node.items().size() ? &node.items()[index] : nullptr;
}

}  // namespace

Property value(std::string name, Property::Value v, int line) {
  return {std::move(name), {"scene.xml", line, 5}, std::move(v)};
}

Spectrum rgb(float r, float g, float b) {
  return {.value = {r, g, b}};
}

Property nested(ObjectRef object, std::string name) {
  const Location where = object->where;
  return {std::move(name), where, std::move(object)};
}

ObjectRef object(std::string tag, std::string type, std::vector<Property> properties,
                 std::string id, int line) {
  return std::make_shared<const Object>(Object{std::move(tag),
                                               std::move(type),
                                               std::move(id),
                                               {"scene.xml", line, 3},
                                               std::move(properties)});
}

ObjectRef bsdf(std::string type, std::vector<Property> properties, std::string id) {
  return object("bsdf", std::move(type), std::move(properties), std::move(id));
}
ObjectRef shape(std::string type, std::vector<Property> properties) {
  return object("shape", std::move(type), std::move(properties));
}
ObjectRef texture(std::string type, std::vector<Property> properties, std::string id) {
  return object("texture", std::move(type), std::move(properties), std::move(id));
}
ObjectRef emitter(std::string type, std::vector<Property> properties) {
  return object("emitter", std::move(type), std::move(properties));
}

Import import_of(const std::vector<ObjectRef>& contents, Dialect dialect) {
  std::vector<Property> properties;
  for (const ObjectRef& part : contents) properties.push_back(nested(part));
  Document document;
  document.scene = object("scene", "", std::move(properties));
  document.dialect = dialect;
  return map_document(document);
}

Import import_of_bsdf(const ObjectRef& material, Dialect dialect) {
  return import_of({shape("rectangle", {nested(material)})}, dialect);
}

std::string part(const Import& import, const std::string& path) {
  const ConfigNode* node = &import.config;
  std::istringstream keys(path);
  for (std::string key; node != nullptr && std::getline(keys, key, '.');) {
    node = step_into(*node, key);
  }
  return node != nullptr ? to_flow_yaml(*node) : "none";
}

std::string material_of(const ObjectRef& material, Dialect dialect) {
  return part(import_of_bsdf(material, dialect), "scene.shapes.0.material");
}

std::vector<std::string> notes(const Import& import) {
  std::vector<std::string> messages;
  for (const ImportNote& note : import.notes) messages.push_back(note.message);
  return messages;
}

LoadedConfig built(Import import) {
  ConfigNode& scene = *import.config.find("scene");
  if (scene.find("sensor") == nullptr) {
    scene.set("sensor", parse_yaml("{ type: perspective }", "test"));
    import.config.set("budget", parse_yaml("{ spp: 1 }", "test"));
  }
  return build_render_config(import.config, registry());
}

}  // namespace pharos::mitsuba::test
