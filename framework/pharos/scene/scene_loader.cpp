#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <pharos/scene/group_table.h>
#include <pharos/scene/reach.h>
#include <pharos/scene/scene_loader.h>
#include <pharos/scene/texture.h>

namespace pharos {
namespace {

/// The keys that an entry of `shapes` may state besides the shape's own parameters.
constexpr std::array<const char*, 4> kAttachments{"material", "emitter", "interior", "exterior"};

constexpr const char* kWithoutArea = "the shape has no area and is left out";

std::vector<ParameterInfo> keys_of(std::span<const char* const> names) {
  std::vector<ParameterInfo> keys(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) keys[i].key = names[i];
  return keys;
}

void check_scene_keys(const ConfigNode& scene) {
  static constexpr std::array<const char*, 8> names{"textures", "materials", "media",  "shapes",
                                                    "groups",   "emitters",  "sensor", "medium"};
  check_keys(scene, keys_of(names));
}

/// The parameters of an entry `type: instance`.
struct InstanceSettings {
  std::string group;
  Transform to_world = {};

  static void describe(Schema<InstanceSettings>& s) {
    s.field("group", &InstanceSettings::group, "Name of the group").required();
    s.field("to_world", &InstanceSettings::to_world, "From the group's space to world space");
  }
};

bool is_instance(const ConfigNode& entry) {
  const ConfigNode* type = entry.find("type");
  return type != nullptr && type->text() == "instance";
}

void check_emitter_place(const Emitter& emitter, const ConfigNode& node, bool on_shape) {
  if (emitter.needs_shape() && !on_shape) {
    node.fail("this emitter needs a shape: state it as 'emitter' of an entry of 'shapes'");
  }
  if (!emitter.needs_shape() && on_shape) {
    node.fail("this emitter stands alone: list it under the scene's 'emitters'");
  }
}

/// Calls `check` and locates its error at `node`.
template <class Check>
void check_at(const ConfigNode& node, Check&& check) {
  try {
    check();
  } catch (const InputError& error) {
    node.fail(error.what());
  }
}

/// Reads a scene's mapping part by part and writes the values in force into `resolved`. The errors
/// of all parts are thrown together.
class SceneReader {
 public:
  SceneReader(const ConfigNode& scene, BuildContext& context, ConfigNode& resolved)
      : scene_(scene), context_(context), resolved_(resolved) {}

  SceneParts read() {
    resolved_ = ConfigNode::mapping();
    context_.named.clear();  // names are valid in this scene only
    errors_.attempt([&] { read_named<Texture>("textures"); });
    errors_.attempt([&] { read_named<Bsdf>("materials"); });
    errors_.attempt([&] { read_named<Medium>("media"); });
    SceneParts parts;
    EntryList world;
    errors_.attempt([&] { read_groups(); });
    errors_.attempt([&] { world = read_entries("shapes", given("shapes"), resolved_); });
    errors_.attempt([&] { read_emitters(parts); });
    errors_.attempt([&] { read_sensor(parts); });
    errors_.attempt(
        [&] { parts.medium = read_part<Medium>("medium", given("medium"), resolved_); });
    errors_.raise();
    groups_.place(std::move(world), parts);
    return parts;
  }

 private:
  void read_emitters(SceneParts& parts) {
    read_list("emitters", given("emitters"), resolved_,
              [&](const ConfigNode& entry, ConfigNode& resolved) {
                parts.emitters.push_back(build<Emitter>(entry, resolved));
                check_emitter_place(*parts.emitters.back(), entry, false);
                return true;
              });
  }

  void read_sensor(SceneParts& parts) {
    const ConfigNode node = given("sensor");
    parts.sensor = read_part<Sensor>("sensor", node, resolved_);
    if (parts.sensor == nullptr) return;
    check_at(node, [&] { check_reach(parts.sensor->position(), "the sensor"); });
  }

  /// Returns the node under `key`, or a null node if there is none.
  ConfigNode given(const char* key) const {
    const ConfigNode* node = scene_.find(key);
    return node != nullptr ? *node : ConfigNode();
  }

  template <class Contract>
  Ref<Contract> build(const ConfigNode& node, ConfigNode& resolved) {
    return context_.registry.build<Contract>(node, context_, resolved);
  }

  /// Returns the component at `node` and resolves it under `key` of `resolved`. Returns null for a
  /// null node.
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
      BuildContext::Named named{contract, entry.key, nullptr, std::nullopt};
      errors_.attempt([&] {
        try {
          named.component = build<Contract>(entry.value, resolved);
        } catch (const InputError& error) {
          named.error = error;
          throw;
        }
      });
      context_.named.push_back(std::move(named));
      all.set(entry.key, std::move(resolved));
    }
    resolved_.set(key, std::move(all));
  }

  /// Reads the entries of `list` by `read_entry(entry, part)` and resolves them under `key` of
  /// `resolved`. Entries for which it returns false are left out.
  template <class ReadEntry>
  void read_list(const std::string& key, const ConfigNode& list, ConfigNode& resolved,
                 const ReadEntry& read_entry) {
    if (list.is_null()) return;
    if (!list.is_sequence()) fail_type(list, "a list of " + key);
    ConfigNode all = ConfigNode::sequence();
    for (const ConfigNode& entry : list.items()) {
      ConfigNode part;
      bool is_kept = false;
      errors_.attempt([&] { is_kept = read_entry(entry, part); });
      if (is_kept) all.items().push_back(std::move(part));
    }
    resolved.set(key, std::move(all));
  }

  EntryList read_entries(const std::string& key, const ConfigNode& list, ConfigNode& resolved) {
    EntryList entries;
    read_list(key, list, resolved, [&](const ConfigNode& entry, ConfigNode& part) {
      if (is_instance(entry)) {
        entries.instances.push_back(read_instance(entry, part));
        return true;
      }
      SceneObject object = read_object(entry, part);
      const bool is_visible = object.shape->area() > 0;
      if (is_visible) entries.objects.push_back(std::move(object));
      if (!is_visible) context_.notes.push_back({entry.where(), kWithoutArea});
      return is_visible;
    });
    return entries;
  }

  void read_groups() {
    const ConfigNode dictionary = given("groups");
    if (dictionary.is_null()) return;
    if (!dictionary.is_mapping()) fail_type(dictionary, "a mapping from names to lists of shapes");
    ConfigNode all = ConfigNode::mapping();
    for (const ConfigNode::Entry& group : dictionary.entries()) {
      if (!group.value.is_sequence()) fail_type(group.value, "a list of shapes");
      for (const ConfigNode& entry : group.value.items()) {
        errors_.attempt([&] { check_group_entry(entry); });
      }
      groups_.add(group.key, read_entries(group.key, group.value, all));
    }
    resolved_.set("groups", std::move(all));
  }

  /// Refuses emitters in groups, because a light is sampled at its one place in the world.
  static void check_group_entry(const ConfigNode& entry) {
    const ConfigNode* emitter = entry.find("emitter");
    if (emitter == nullptr || emitter->is_null()) return;
    throw InputError(entry.where_key("emitter"),
                     "an emitter cannot stand in a group: list its shape under 'shapes'");
  }

  InstanceEntry read_instance(const ConfigNode& entry, ConfigNode& resolved) {
    for (const char* key : kAttachments) {
      if (entry.find(key) == nullptr) continue;
      throw InputError(entry.where_key(key), "an instance has no '" + std::string(key) +
                                                 "' of its own: state it in the group's entries");
    }
    static const Schema<InstanceSettings> schema = [] {
      Schema<InstanceSettings> s;
      InstanceSettings::describe(s);
      return s;
    }();
    resolved = ConfigNode::mapping();
    resolved.set("type", ConfigNode::scalar("instance"));
    InstanceSettings settings = schema.read(entry, context_, resolved, "type");
    return {std::move(settings.group), settings.to_world, entry.find("group")->where()};
  }

  /// Checks the keys of an entry. The shape's plugin knows its own parameters only. The check here
  /// compares a mistyped key with all keys that the entry may have.
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
    check_at(entry, [&] { check_reach(object.shape->bounds(), "the shape"); });
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
  InputErrorList errors_;
  GroupTable groups_;
};

SceneParts read_mapping(const ConfigNode& scene, BuildContext& context, ConfigNode& resolved) {
  if (!scene.is_mapping()) fail_type(scene, "a scene file's path or a scene's mapping");
  check_scene_keys(scene);
  return SceneReader(scene, context, resolved).read();
}

}  // namespace

void check_sensor_reach(const Sensor& sensor, int width, int height, const ConfigNode& node) {
  check_at(node, [&] {
    check_reach(sensor.position(), "the sensor");
    const auto prepared = sensor.prepare(width, height);
    // The corners of the lens and of the film. Positions are less than 1.
    for (int i = 0; i < 16; ++i) {
      const auto bit = [&](int k) { return (i >> k & 1) != 0 ? std::nextafter(1.0f, 0.0f) : 0.0f; };
      const LensPoint lens = prepared->sample_lens({bit(0), bit(1)});
      check_reach(prepared->ray(lens, {bit(2), bit(3)}).origin, "the sensor");
    }
  });
}

SceneParts Value<SceneParts>::read(const ConfigNode& node, BuildContext& context,
                                   ConfigNode& resolved) {
  if (!node.is_scalar()) return read_mapping(node, context, resolved);
  const auto path = Value<std::filesystem::path>::read(node, context, resolved);
  if (const std::string problem = file_problem(path); !problem.empty()) {
    node.fail("the scene '" + path.string() + "': " + problem);
  }
  return read_mapping(read_config(path, &context.sources), context, resolved);
}

}  // namespace pharos
