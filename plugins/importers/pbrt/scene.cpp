#include "scene.h"

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "../shared/nodes.h"

namespace pharos::pbrt {
namespace {

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

[[noreturn]] void fail_twice(const Location& where, const char* what, const std::string& name) {
  throw InputError(where, fmt::format("the {} '{}' is defined twice", what, one_line(name, 60)));
}

void set_if_any(ConfigNode& node, const char* key, ConfigNode part) {
  if (part.items().empty() && part.entries().empty() && !part.is_scalar()) return;
  const Location where = part.where();
  node.set(key, std::move(part), where);
}

}  // namespace

Scene::Scene(std::filesystem::path folder, importing::ReadingBudget& budget)
    : folder_(std::move(folder)), colors_(folder_, budget) {}

ConfigNode Scene::file_node(const std::string& name, const Location& where) const {
  const std::filesystem::path path = file_in(folder_, name);
  if (std::filesystem::path(name).is_absolute()) return importing::text_node(path.string(), where);
  // Nodes are read relative to the file that contains them.
  if (std::filesystem::path(where.file).parent_path() == folder_) {
    return importing::text_node(path.lexically_relative(folder_).string(), where);
  }
  return importing::text_node(std::filesystem::absolute(path).string(), where);
}

void Scene::fail_unknown(const Location& where, const char* what, const std::string& name,
                         const std::vector<std::string>& known) const {
  if (const auto failed = failed_.find({what, name}); failed != failed_.end()) {
    throw InputError(failed->second);
  }
  throw InputError(where, fmt::format("there is no {} '{}'{}", what, one_line(name, 60),
                                      suggestion(name, known)));
}

void Scene::add_texture(TextureKind kind, const std::string& name, const Location& where,
                        ConfigNode node, std::function<std::optional<double>()> average) {
  const auto [entry, is_new] = textures_by_name_.try_emplace({name, kind});
  if (!is_new) fail_twice(where, "texture", name);
  entry->second = {texture_names_.take(name), std::move(average)};
  textures_.entries().push_back({entry->second.name, where, std::move(node)});
}

const NamedTexture& Scene::texture(const Parameter& parameter, TextureKind kind) const {
  if (parameter.texts.size() != 1) {
    throw InputError(parameter.where,
                     fmt::format("'{}' must be the name of one texture", parameter.name));
  }
  const std::string& name = parameter.texts.front();
  const TextureKind other =
      kind == TextureKind::number ? TextureKind::spectrum : TextureKind::number;
  for (const TextureKind wanted : {kind, other}) {
    const auto found = textures_by_name_.find({name, wanted});
    if (found != textures_by_name_.end()) return found->second;
  }
  std::vector<std::string> known;
  for (const auto& [key, texture] : textures_by_name_) known.push_back(key.first);
  fail_unknown(parameter.where, "texture", name, known);
}

std::string Scene::add_material(const Location& where, ConfigNode node) {
  std::string entry = material_names_.take("");
  append_material(entry, where, std::move(node));
  return entry;
}

void Scene::append_material(const std::string& entry, const Location& where, ConfigNode node) {
  const ConfigNode* type = node.find("type");
  if (type != nullptr && type->text() == "pass_through") interfaces_.insert(entry);
  materials_.entries().push_back({entry, where, std::move(node)});
}

bool Scene::is_interface(const std::string& entry) const {
  return interfaces_.contains(entry);
}

std::string Scene::material_entry(const std::string& name, const Location& where, bool defines) {
  const auto [found, is_new] = materials_by_name_.try_emplace(name);
  Entry& entry = found->second;
  if (is_new) entry = {material_names_.take(name), where};
  if (defines && entry.is_defined) fail_twice(where, "material", name);
  entry.is_defined = entry.is_defined || defines;
  return entry.name;
}

void Scene::define_material(const std::string& name, const Location& where, ConfigNode node) {
  append_material(material_entry(name, where, true), where, std::move(node));
}

std::string Scene::material(const std::string& name, const Location& where) {
  return material_entry(name, where, false);
}

void Scene::define_medium(const std::string& name, const Location& where,
                          std::optional<ConfigNode> node) {
  const auto [entry, is_new] = media_by_name_.try_emplace(name);
  if (!is_new) fail_twice(where, "medium", name);
  if (!node) return;
  entry->second = medium_names_.take(name);
  media_.set(entry->second, std::move(*node), where);
}

std::string Scene::medium(const std::string& name, const Location& where) const {
  if (name.empty()) return "";
  const auto found = media_by_name_.find(name);
  if (found == media_by_name_.end()) fail_unknown(where, "medium", name, keys_of(media_by_name_));
  return found->second;
}

void Scene::begin_object(const std::string& name, const Location& where) {
  if (object_ != nullptr) throw InputError(where, "ObjectBegin within another object");
  const auto [found, is_new] = objects_.try_emplace(name);
  if (!is_new) fail_twice(where, "object", name);
  found->second = {group_names_.take(name), ConfigNode::sequence(where)};
  order_of_objects_.push_back(name);
  object_ = &found->second;
}

void Scene::end_object(const Location& where) {
  if (object_ == nullptr) throw InputError(where, "ObjectEnd without ObjectBegin");
  object_ = nullptr;
}

std::string Scene::object(const std::string& name, const Location& where) const {
  const auto found = objects_.find(name);
  if (found == objects_.end()) fail_unknown(where, "object", name, keys_of(objects_));
  // An object without shapes has no entry in the config.
  return found->second.shapes.items().empty() ? "" : found->second.entry;
}

void Scene::add_shape(ConfigNode node) {
  ConfigNode& list = object_ != nullptr ? object_->shapes : shapes_;
  list.items().push_back(std::move(node));
}

Import Scene::finished() {
  std::vector<std::string> defined;
  for (const auto& [name, entry] : materials_by_name_) {
    if (entry.is_defined) defined.push_back(name);
  }
  for (const auto& [name, entry] : materials_by_name_) {
    if (!entry.is_defined) fail_unknown(entry.where, "material", name, defined);
  }
  ConfigNode groups = ConfigNode::mapping();
  for (const std::string& name : order_of_objects_) {
    Group& group = objects_.at(name);
    if (group.shapes.items().empty()) continue;
    const Location where = group.shapes.where();
    groups.set(group.entry, std::move(group.shapes), where);
  }
  ConfigNode scene = ConfigNode::mapping();
  set_if_any(scene, "textures", std::move(textures_));
  set_if_any(scene, "materials", std::move(materials_));
  set_if_any(scene, "media", std::move(media_));
  set_if_any(scene, "groups", std::move(groups));
  set_if_any(scene, "shapes", std::move(shapes_));
  set_if_any(scene, "emitters", std::move(emitters_));
  set_if_any(scene, "sensor", std::move(sensor));
  set_if_any(scene, "medium", std::move(medium_of_camera));
  ConfigNode config = ConfigNode::mapping();
  config.set("scene", std::move(scene));
  set_if_any(config, "film", std::move(film));
  set_if_any(config, "sampler", std::move(sampler));
  set_if_any(config, "integrator", std::move(integrator));
  set_if_any(config, "budget", std::move(budget));
  log_.result().config = std::move(config);
  return std::move(log_.result());
}

}  // namespace pharos::pbrt
