// Maps Mitsuba's daylight. The sun's position is given directly or by a date and a place. The
// zenith is +y in 0.x and +z in 3.
#include "sky.h"

#include <array>

namespace pharos::mitsuba {
namespace {

constexpr double kDefaultTurbidity = 3;
/// The default reflectance of the ground. The one of Mitsuba 0.x is also the one of Pharos.
constexpr double kGroundOf0 = 0.15, kGroundOf3 = 0.3;
/// The width of the sun's disk in Pharos and in Mitsuba 0.x, and its default in Mitsuba 3
/// [degrees].
constexpr double kSunWidth = 0.5358, kSunApertureOf3 = 0.5338;
constexpr std::array kObserver{"latitude", "longitude", "timezone", "year",  "month",
                               "day",      "hour",      "minute",   "second"};

void set_sun_place(Part& part, ConfigNode& node) {
  const Property* stated = part.object().find("sun_direction");
  if (stated != nullptr) {
    part.ignore(
        {"latitude", "longitude", "timezone", "year", "month", "day", "hour", "minute", "second"});
    node.set("sun_direction", triple_node(*part.triple("sun_direction"), stated->where),
             stated->where);
    return;
  }
  ConfigNode observer = ConfigNode::mapping(part.where());
  for (const char* key : kObserver) {
    if (part.has(key)) observer.set(key, part.number_or(key, 0), part.where());
  }
  if (!observer.entries().empty()) node.set("observer", std::move(observer), part.where());
}

/// Sets the transform from Mitsuba's sky to the world.
void set_to_world(Part& part, ConfigNode& node) {
  if (part.map().document().dialect == Dialect::mitsuba_0) {
    return part.copy_transform(node, "to_world");
  }
  const Transform turned = Transform::rotate({1, 0, 0}, 90);
  const Property* stated = part.object().find("to_world");
  const Location& there = stated != nullptr ? stated->where : part.where();
  const Transform to_world = part.transform("to_world").value_or(Transform()) * turned;
  node.set("to_world", transform_node(to_world, there), there);
}

ConfigNode half(Part& part, const char* type, const char* factor) {
  ConfigNode node = part.node(type);
  node.set("turbidity", part.number_or("turbidity", kDefaultTurbidity), part.where());
  set_sun_place(part, node);
  const double scale = part.number("scale", 1) * part.number(factor, 1);
  if (scale != 1) node.set("scale", number_node(scale, part.where()), part.where());
  if (part.has("stretch")) node.set("stretch", part.number_or("stretch", 1), part.where());
  set_to_world(part, node);
  return node;
}

ConfigNode sky_half(Part& part) {
  ConfigNode node = half(part, "sky", "sky_scale");
  const bool is_0 = part.map().document().dialect == Dialect::mitsuba_0;
  if (!is_0 || part.has("albedo")) {
    node.set("ground", part.color_or("albedo", is_0 ? kGroundOf0 : kGroundOf3), part.where());
  }
  return node;
}

ConfigNode sun_half(Part& part) {
  ConfigNode node = half(part, "sun", "sun_scale");
  double radius = part.number("sun_radius_scale", 1);
  if (part.map().document().dialect == Dialect::mitsuba_2) {
    radius = part.number("sun_aperture", kSunApertureOf3) / kSunWidth;
  }
  if (radius != 1) node.set("radius_scale", number_node(radius, part.where()), part.where());
  return node;
}

}  // namespace

bool is_daylight(std::string_view type) {
  return type == "sky" || type == "sun" || type == "sunsky";
}

std::vector<ConfigNode> map_daylight(SceneMap& scene, const Object& emitter) {
  SceneMap::Entry entry(scene, emitter);
  Part part(scene, emitter);
  std::vector<ConfigNode> halves;
  std::string stands = "emitter";
  if (emitter.type != "sun") {
    halves.push_back(sky_half(part));
    stands += " sky";
  }
  if (emitter.type != "sky") {
    halves.push_back(sun_half(part));
    stands += halves.size() > 1 ? " and sun" : " sun";
  }
  // Settings for the resolution of tables and the sampling of daylight.
  part.ignore({"resolution", "sun_samples", "complex_sun", "sampling_weight"});
  part.finish();
  entry.done(stands);
  return halves;
}

}  // namespace pharos::mitsuba
