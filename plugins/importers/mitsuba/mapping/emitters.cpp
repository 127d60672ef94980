#include "emitters.h"

#include <fmt/core.h>

#include "sky.h"

namespace pharos::mitsuba {
namespace {

ConfigNode map_area(Part& part) {
  part.ignore({"sampling_weight"});
  ConfigNode node = part.node("area");
  node.set("radiance", part.texture_or("radiance", 1), part.where());
  return node;
}

ConfigNode map_point(Part& part) {
  ConfigNode node = part.node("point");
  node.set("intensity", part.color_or("intensity", 1), part.where());
  if (const std::optional<Vec3> position = part.triple("position")) {
    node.set("position", triple_node(*position, part.where()), part.where());
  }
  part.copy_transform(node, "to_world");
  return node;
}

ConfigNode map_spot(Part& part) {
  ConfigNode node = part.node("spot");
  node.set("intensity", part.color_or("intensity", 1), part.where());
  const double cutoff = part.number("cutoff_angle", 20);
  node.set("cutoff_angle", part.number_or("cutoff_angle", cutoff), part.where());
  node.set("beam_width", part.number_or("beam_width", cutoff * 3 / 4), part.where());
  node.set("falloff", text_node("linear", part.where()), part.where());
  part.copy_transform(node, "to_world");
  return node;
}

ConfigNode map_directional(Part& part) {
  ConfigNode node = part.node("directional");
  node.set("irradiance", part.color_or("irradiance", 1), part.where());
  const std::optional<Vec3> stated = part.triple("direction");
  Vec3 direction = stated.value_or(Vec3{0, 0, 1});
  if (const std::optional<Transform> to_world = part.transform("to_world")) {
    direction = to_world->vector(direction);
  }
  node.set("direction", triple_node(direction, part.where()), part.where());
  return node;
}

ConfigNode map_constant(Part& part) {
  ConfigNode node = part.node("constant");
  node.set("radiance", part.color_or("radiance", 1), part.where());
  return node;
}

ConfigNode map_environment(Part& part) {
  part.ignore({"cache", "mis_compensation"});
  ConfigNode node = part.node("environment_map");
  node.set("file", part.file("filename"), part.where());
  if (part.has("scale")) node.set("scale", part.number_or("scale", 1), part.where());
  part.copy_transform(node, "to_world");
  if (part.number("gamma", -1) > 0) {
    part.note("emitter envmap: 'gamma' is left out: images of 8 and 16 bits are taken as sRGB");
  }
  return node;
}

[[noreturn]] ConfigNode refuse(Part& part) {
  throw InputError(part.where(),
                   fmt::format("emitter '{}' has no counterpart in Pharos", part.object().type));
}

[[noreturn]] ConfigNode refuse_alone(Part& part) {
  throw InputError(part.where(),
                   fmt::format("emitter '{}' needs a shape to stand in", part.object().type));
}

[[noreturn]] ConfigNode refuse_on_shape(Part& part) {
  throw InputError(part.where(),
                   fmt::format("emitter '{}' cannot stand in a shape", part.object().type));
}

/// Stands for daylight, which map_daylight() maps.
ConfigNode is_several(Part& part) {
  return part.node("sky");
}

using Mapper = ConfigNode (*)(Part&);
using Mappers = std::map<std::string_view, Mapper>;

const Mappers& standing_alone() {
  static const Mappers all{{"area", refuse_alone},
                           {"collimated", refuse},
                           {"constant", map_constant},
                           {"directional", map_directional},
                           {"directionalarea", refuse_alone},
                           {"envmap", map_environment},
                           {"point", map_point},
                           {"projector", refuse},
                           {"sky", is_several},
                           {"spot", map_spot},
                           {"sun", is_several},
                           {"sunsky", is_several}};
  return all;
}

const Mappers& on_shapes() {
  static const Mappers all = [] {
    Mappers mappers;
    for (const auto& [type, mapper] : standing_alone()) mappers[type] = refuse_on_shape;
    mappers["area"] = map_area;
    mappers["directionalarea"] = refuse;
    return mappers;
  }();
  return all;
}

}  // namespace

ConfigNode map_shape_emitter(SceneMap& scene, const Object& emitter, UvSense sense) {
  return map_part(scene, emitter, sense, "emitter", mapper_of(on_shapes(), emitter));
}

void map_emitter(SceneMap& scene, const Object& emitter, std::vector<ConfigNode>& entries) {
  const Mapper& mapper = mapper_of(standing_alone(), emitter);
  if (is_daylight(emitter.type)) {
    for (ConfigNode& half : map_daylight(scene, emitter)) entries.push_back(std::move(half));
    return;
  }
  entries.push_back(map_part(scene, emitter, UvSense::same, "emitter", [&](Part& part) {
    part.ignore({"sampling_weight"});
    return mapper(part);
  }));
}

}  // namespace pharos::mitsuba
