#include "shapes.h"

#include <fmt/core.h>

#include "bsdfs.h"
#include "emitters.h"
#include "media.h"

namespace pharos::mitsuba {
namespace {

using GeometryMapper = Geometry (*)(Part&, bool);

[[noreturn]] Geometry refuse(Part& part, bool) {
  throw InputError(part.where(),
                   fmt::format("shape '{}' has no counterpart in Pharos", part.object().type));
}

/// Stands for types that are groups or consist of other shapes; see map_shape().
Geometry is_compound(Part&, bool) {
  return {};
}

const std::map<std::string_view, GeometryMapper>& mappers() {
  static const std::map<std::string_view, GeometryMapper> all{{"bsplinecurve", refuse},
                                                              {"cube", map_cube},
                                                              {"cylinder", map_cylinder},
                                                              {"deformable", refuse},
                                                              {"disk", map_disk},
                                                              {"ellipsoids", refuse},
                                                              {"hair", refuse},
                                                              {"heightfield", refuse},
                                                              {"instance", is_compound},
                                                              {"linearcurve", refuse},
                                                              {"merge", is_compound},
                                                              {"obj", map_obj},
                                                              {"ply", map_ply},
                                                              {"rectangle", map_rectangle},
                                                              {"sdfgrid", refuse},
                                                              {"serialized", map_serialized},
                                                              {"shapegroup", is_compound},
                                                              {"sphere", map_sphere}};
  return all;
}

/// The objects in a shape besides its geometry.
struct Attachments {
  const Object* bsdf = nullptr;
  const Object* emitter = nullptr;
  std::vector<std::pair<const char*, const Object*>> media;  ///< by `interior` and `exterior`
};

Attachments read_attachments(Part& part) {
  Attachments attached{part.child("bsdf"), part.child("emitter"), {}};
  for (const char* side : {"interior", "exterior"}) {
    const Property* p = part.object().find(side);
    const auto* nested =
        p != nullptr ? std::get_if<std::shared_ptr<const Object>>(&p->value) : nullptr;
    if (nested == nullptr || (*nested)->tag != "medium") continue;
    part.take(side);
    attached.media.emplace_back(side, nested->get());
  }
  return attached;
}

/// Returns Mitsuba's default for a shape without a bsdf. Emitters are black, and in 0.x a shape
/// that only bounds a medium is invisible.
std::optional<ConfigNode> unstated_material(Part& part, const Attachments& attached) {
  ConfigNode node;
  if (attached.emitter != nullptr) {
    node = part.node("diffuse");
    node.set("reflectance", number_node(0, part.where()), part.where());
    return node;
  }
  const bool is_old = part.map().document().dialect == Dialect::mitsuba_0;
  if (is_old && !attached.media.empty()) return part.node("pass_through");
  return std::nullopt;
}

std::optional<ConfigNode> material(Part& part, const Attachments& attached, UvSense sense) {
  if (attached.bsdf == nullptr) return unstated_material(part, attached);
  return map_bsdf(part.map(), *attached.bsdf, sense, attached.bsdf->where);
}

void attach(Part& part, const Attachments& attached, Geometry& geometry) {
  std::vector<std::pair<std::string, ConfigNode>> parts;
  if (std::optional<ConfigNode> node = material(part, attached, geometry.sense)) {
    parts.emplace_back("material", std::move(*node));
  }
  if (attached.emitter != nullptr) {
    parts.emplace_back("emitter", map_shape_emitter(part.map(), *attached.emitter, geometry.sense));
  }
  for (const auto& [side, medium] : attached.media) {
    if (std::optional<ConfigNode> node = map_medium(part.map(), *medium)) {
      parts.emplace_back(side, std::move(*node));
    }
  }
  for (ConfigNode& shape : geometry.nodes) {
    for (const auto& [key, node] : parts) shape.set(key, node, node.where());
  }
}

void map_simple(SceneMap& scene, const Object& shape, GeometryMapper mapper,
                std::vector<ConfigNode>& entries) {
  SceneMap::Entry entry(scene, shape);
  Part part(scene, shape);
  const Attachments attached = read_attachments(part);
  const bool has_texture = (attached.bsdf != nullptr && scene.depends_on_uv(*attached.bsdf)) ||
                           (attached.emitter != nullptr && scene.depends_on_uv(*attached.emitter));
  Geometry geometry = mapper(part, has_texture);
  attach(part, attached, geometry);
  part.finish();
  entry.done("shape " + geometry.nodes[0].find("type")->text());
  for (ConfigNode& node : geometry.nodes) entries.push_back(std::move(node));
}

/// Returns a list of the shapes nested in `part`.
ConfigNode nested_shapes(Part& part) {
  ConfigNode list = ConfigNode::sequence(part.where());
  for (const Object* shape : part.children("shape")) {
    map_shape(part.map(), *shape, list.items());
  }
  return list;
}

std::string group_name(SceneMap& scene, const Object& group) {
  return scene.name_in(scene.groups(), group, UvSense::same, [&] {
    SceneMap::Entry entry(scene, group);
    Part part(scene, group);
    ConfigNode list = nested_shapes(part);
    part.finish();
    entry.done("group");
    return list;
  });
}

void map_instance(SceneMap& scene, const Object& instance, std::vector<ConfigNode>& entries) {
  entries.push_back(map_part(scene, instance, UvSense::same, "shape", [&](Part& part) {
    const Object* group = part.child("shape");
    if (group == nullptr || group->type != "shapegroup") {
      throw InputError(part.where(), "shape 'instance': expected a 'shapegroup' in it");
    }
    ConfigNode node = part.node("instance");
    node.set("group", text_node(group_name(scene, *group), group->where), part.where());
    part.copy_transform(node, "to_world");
    return node;
  }));
}

}  // namespace

void map_shape(SceneMap& scene, const Object& shape, std::vector<ConfigNode>& entries) {
  const GeometryMapper mapper = mapper_of(mappers(), shape);
  if (shape.type == "shapegroup") return;  // recorded by its first instance
  if (shape.type == "instance") return map_instance(scene, shape, entries);
  if (shape.type != "merge") return map_simple(scene, shape, mapper, entries);
  SceneMap::Entry entry(scene, shape);
  Part part(scene, shape);
  ConfigNode list = nested_shapes(part);
  part.finish();
  entry.done(fmt::format("{} shapes", list.items().size()));
  for (ConfigNode& node : list.items()) entries.push_back(std::move(node));
}

}  // namespace pharos::mitsuba
