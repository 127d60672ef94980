#include <array>
#include <span>
#include <string>
#include <utility>

#include <pharos/scene/scene_loader.h>
#include <pharos/scene/texture.h>

namespace pharos {
namespace {

/// What an entry of `shapes` may state besides the shape's own parameters.
constexpr std::array<const char*, 4> kAttachments{"material", "emitter", "interior", "exterior"};

std::vector<ParameterInfo> keys_of(std::span<const char* const> names) {
  std::vector<ParameterInfo> keys(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) keys[i].key = names[i];
  return keys;
}

void check_scene_keys(const ConfigNode& scene) {
  static constexpr std::array<const char*, 7> names{"textures", "materials", "media", "shapes",
                                                    "emitters", "sensor",    "medium"};
  check_keys(scene, keys_of(names));
}

void check_emitter_place(const Emitter& emitter, const ConfigNode& node, bool on_shape) {
  if (emitter.needs_shape() && !on_shape) {
    node.fail("this emitter needs a shape: state it as 'emitter' of an entry of 'shapes'");
  }
  if (!emitter.needs_shape() && on_shape) {
    node.fail("this emitter stands alone: list it under the scene's 'emitters'");
  }
}

/// Reads one scene's mapping part by part, and writes what is in force into `resolved`.
class SceneReader {
 public:
  SceneReader(const ConfigNode& scene, BuildContext& context, ConfigNode& resolved)
      : scene_(scene), context_(context), resolved_(resolved) {}

  SceneParts read() {
    resolved_ = ConfigNode::mapping();
    context_.named.clear();  // names are those of this scene alone
    read_named<Texture>("textures");
    read_named<Bsdf>("materials");
    read_named<Medium>("media");
    SceneParts parts;
    read_list("shapes", [&](const ConfigNode& entry, ConfigNode& resolved) {
      parts.objects.push_back(read_object(entry, resolved));
    });
    read_list("emitters", [&](const ConfigNode& entry, ConfigNode& resolved) {
      parts.emitters.push_back(build<Emitter>(entry, resolved));
      check_emitter_place(*parts.emitters.back(), entry, false);
    });
    parts.sensor = read_part<Sensor>("sensor", given("sensor"), resolved_);
    parts.medium = read_part<Medium>("medium", given("medium"), resolved_);
    return parts;
  }

 private:
  /// The node under `key`; a null node when there is none.
  ConfigNode given(const char* key) const {
    const ConfigNode* node = scene_.find(key);
    return node != nullptr ? *node : ConfigNode();
  }

  template <class Contract>
  Ref<Contract> build(const ConfigNode& node, ConfigNode& resolved) {
    return context_.registry.build<Contract>(node, context_, resolved);
  }

  /// The component at `node`, resolved under `key` of `resolved`; null for a null node.
  template <class Contract>
  Ref<Contract> read_part(const char* key, const ConfigNode& node, ConfigNode& resolved) {
    if (node.is_null()) return nullptr;
    ConfigNode part;
    Ref<Contract> component = build<Contract>(node, part);
    resolved.set(key, std::move(part));
    return component;
  }

  template <class Contract>
  void read_named(const char* key) {
    const ConfigNode dictionary = given(key);
    if (dictionary.is_null()) return;
    const std::string contract(Contract::contract_name);
    if (!dictionary.is_mapping()) fail_type(dictionary, "a mapping from names to " + contract);
    ConfigNode all = ConfigNode::mapping();
    for (const ConfigNode::Entry& entry : dictionary.entries()) {
      ConfigNode resolved;
      context_.named.push_back({contract, entry.key, build<Contract>(entry.value, resolved)});
      all.set(entry.key, std::move(resolved));
    }
    resolved_.set(key, std::move(all));
  }

  template <class ReadEntry>
  void read_list(const char* key, const ReadEntry& read_entry) {
    const ConfigNode list = given(key);
    if (list.is_null()) return;
    if (!list.is_sequence()) fail_type(list, std::string("a list of ") + key);
    ConfigNode all = ConfigNode::sequence();
    for (const ConfigNode& entry : list.items()) {
      ConfigNode resolved;
      read_entry(entry, resolved);
      all.items().push_back(std::move(resolved));
    }
    resolved_.set(key, std::move(all));
  }

  /// The shape's plugin knows its own parameters only; the entry is checked here, so that a
  /// mistyped key is compared with all that may be stated.
  void check_object_keys(const ConfigNode& entry) const {
    const ConfigNode* type = entry.find("type");
    if (type == nullptr) return;
    const PluginInfo* plugin = context_.registry.find(Shape::contract_name, type->text());
    if (plugin == nullptr) return;
    std::vector<ParameterInfo> keys = plugin->parameters;
    for (ParameterInfo& key : keys_of(kAttachments)) keys.push_back(std::move(key));
    check_keys(entry, keys, "type");
  }

  SceneObject read_object(const ConfigNode& entry, ConfigNode& resolved) {
    check_object_keys(entry);
    ConfigNode shape = entry;
    ConfigNode material = shape.take("material");
    const ConfigNode emitter = shape.take("emitter");
    const ConfigNode interior = shape.take("interior");
    const ConfigNode exterior = shape.take("exterior");
    if (material.is_null()) material = ConfigNode::scalar("default", entry.where());
    SceneObject object;
    object.shape = build<Shape>(shape, resolved);
    object.bsdf = read_part<Bsdf>("material", material, resolved);
    object.emitter = read_part<Emitter>("emitter", emitter, resolved);
    if (object.emitter != nullptr) check_emitter_place(*object.emitter, emitter, true);
    object.interior = read_part<Medium>("interior", interior, resolved);
    object.exterior = read_part<Medium>("exterior", exterior, resolved);
    return object;
  }

  const ConfigNode& scene_;
  BuildContext& context_;
  ConfigNode& resolved_;
};

SceneParts read_mapping(const ConfigNode& scene, BuildContext& context, ConfigNode& resolved) {
  if (!scene.is_mapping()) fail_type(scene, "a scene file's path or a scene's mapping");
  check_scene_keys(scene);
  return SceneReader(scene, context, resolved).read();
}

}  // namespace

SceneParts Value<SceneParts>::read(const ConfigNode& node, BuildContext& context,
                                   ConfigNode& resolved) {
  if (!node.is_scalar()) return read_mapping(node, context, resolved);
  const auto path = Value<std::filesystem::path>::read(node, context, resolved);
  if (!std::filesystem::exists(path)) node.fail("there is no scene file '" + path.string() + "'");
  if (std::filesystem::is_directory(path)) {
    node.fail("expected a scene file, found the folder '" + path.string() + "'");
  }
  return read_mapping(read_config(path), context, resolved);
}

}  // namespace pharos
