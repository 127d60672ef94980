// pbrt divides the spectrum of a light by its luminance, see colors.h; `scale` and `power` make it
// bright. RGB values are radiances in Rec.709, as in Pharos.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "mapping.h"
#include "part.h"

namespace pharos::pbrt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

/// Returns the color and its factor. `power_of_one` is the power (or irradiance) `unit` of the
/// light with the color 1.
struct Brightness {
  Color color;
  double scale = 1;
};

/// Reads the color `name`, `scale`, and `power`, the total of the light (its power or irradiance).
/// `power_of_one` is the total of the light with the color 1.
Brightness read_brightness(Part& part, const char* name, const char* power, double power_of_one) {
  const std::optional<Color> stated = part.color(name, ColorRole::light);
  Brightness result{stated.value_or(Color{.value = Rgb(1), .is_gray = true}),
                    part.number("scale", 1)};
  for (int c = 0; c < 3; ++c) result.color.value[c] = std::max(0.0f, result.color.value[c]);
  if (result.scale < 0) throw InputError(part.where("scale"), "'scale' must be at least 0");
  const double total = part.number(power, -1);
  if (total > 0) result.scale *= total / power_of_one;
  return result;
}

void set_brightness(Part& part, ConfigNode& node, const char* key, const Brightness& brightness,
                    const char* name) {
  node.set(key, color_node(brightness.color, part.where(name)), part.where(name));
  if (brightness.scale == 1) return;
  node.set("scale", number_node(brightness.scale, part.where()), part.where());
}

/// Returns the space in which a light shines along +z from the origin.
Transform placed_along(Part& part) {
  const Vec3 from = part.point("from").value_or(Vec3{0, 0, 0});
  const Vec3 to = part.point("to").value_or(Vec3{0, 0, 1});
  const Vec3 along = to - from;
  if (!(length(along) > 0)) {
    throw InputError(part.where("to"), "'from' and 'to' are the same point");
  }
  const Vec3 up = std::abs(along.y) < 0.99f * length(along) ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  return part.scene().state().to_world * Transform::look_at(from, to, up);
}

ConfigNode map_point(Part& part) {
  ConfigNode node = part.node("point");
  set_brightness(part, node, "intensity", read_brightness(part, "I", "power", 4 * kPi), "I");
  const Vec3 from = part.point("from").value_or(Vec3{0, 0, 0});
  node.set("position", triple_node(part.scene().state().to_world.point(from), part.where("from")),
           part.where("from"));
  return node;
}

ConfigNode map_spot(Part& part) {
  const double cone = part.number("coneangle", 30), delta = part.number("conedeltaangle", 5);
  if (!(cone > 0 && cone <= 180)) {
    throw InputError(part.where("coneangle"),
                     "'coneangle' must be above 0 and at most 180 degrees");
  }
  const double beam = std::clamp(cone - delta, 0.0, cone);
  const double cos_beam = std::cos(beam * kDegree), cos_cone = std::cos(cone * kDegree);
  const double power_of_one = 2 * kPi * ((1 - cos_beam) + (cos_beam - cos_cone) / 2);
  ConfigNode node = part.node("spot");
  set_brightness(part, node, "intensity", read_brightness(part, "I", "power", power_of_one), "I");
  node.set("cutoff_angle", number_node(cone, part.where("coneangle")), part.where("coneangle"));
  node.set("beam_width", number_node(beam, part.where()), part.where());
  node.set("falloff", text_node("smooth", part.where()), part.where());
  node.set("to_world", transform_node(placed_along(part), part.where()), part.where());
  return node;
}

ConfigNode map_distant(Part& part) {
  ConfigNode node = part.node("directional");
  set_brightness(part, node, "irradiance", read_brightness(part, "L", "illuminance", 1), "L");
  const Vec3 along = placed_along(part).vector({0, 0, 1});
  node.set("direction", triple_node(along, part.where()), part.where());
  return node;
}

ConfigNode map_image(Part& part) {
  ConfigNode node = part.node("environment_map");
  node.set("file", part.file(), part.where("filename"));
  node.set("layout", text_node("equal_area", part.where()), part.where());
  const Brightness brightness = read_brightness(part, "L", "", 1);
  if (part.has("L")) part.note("'L' is left out, the image has the colors");
  if (part.number("illuminance", -1) > 0) part.note("'illuminance' is left out");
  if (brightness.scale != 1) {
    node.set("scale", number_node(brightness.scale, part.where("scale")), part.where("scale"));
  }
  node.set("to_world", transform_node(part.scene().state().to_world, part.where()), part.where());
  return node;
}

ConfigNode map_infinite(Part& part) {
  if (part.has("portal")) part.note("'portal' is left out");
  part.ignore({"portal"});
  if (part.has("filename")) return map_image(part);
  ConfigNode node = part.node("constant");
  set_brightness(part, node, "radiance", read_brightness(part, "L", "illuminance", kPi), "L");
  return node;
}

ConfigNode map_goniometric(Part& part) {
  if (part.has("filename")) part.note("its image is left out, it shines evenly");
  part.ignore({"filename"});
  return map_point(part);
}

ConfigNode map_projection(Part& part) {
  part.note("its image is left out: replaced by a spot");
  const double fov = std::clamp(part.number("fov", 90), 1.0, 179.0);
  ConfigNode node = part.node("spot");
  set_brightness(part, node, "intensity",
                 read_brightness(part, "I", "power", 2 * kPi * (1 - std::cos(fov / 2 * kDegree))),
                 "I");
  for (const char* key : {"cutoff_angle", "beam_width"}) {
    node.set(key, number_node(fov / 2, part.where()), part.where());
  }
  node.set("to_world", transform_node(placed_along(part), part.where()), part.where());
  part.ignore({"filename"});
  return node;
}

using Mapper = ConfigNode (*)(Part&);

}  // namespace

void map_light(Scene& scene, const Statement& light) {
  static const std::map<std::string_view, Mapper> all{
      {"distant", map_distant}, {"goniometric", map_goniometric}, {"infinite", map_infinite},
      {"point", map_point},     {"projection", map_projection},   {"spot", map_spot}};
  const std::size_t object = scene.log().add_object(light.where, "light " + light.type());
  Part part(scene, light, "light");
  ConfigNode node = mapper_of(all, light)(part);
  part.finish();
  scene.log().stands(object, "emitter " + node.find("type")->text());
  scene.add_emitter(std::move(node));
}

ConfigNode map_area_light(Scene& scene, const Statement& light) {
  static const std::map<std::string_view, bool> all{{"diffuse", true}};
  mapper_of(all, light);
  Part part(scene, light, "light");
  ConfigNode node = part.node("area");
  set_brightness(part, node, "radiance", read_brightness(part, "L", "", 1), "L");
  if (part.flag("twosided", false)) part.note("emits on the side of the normal only");
  if (part.has("filename")) part.note("its image is left out, it shines evenly");
  if (part.number("power", -1) > 0) part.note("'power' is left out, 'L' and 'scale' count");
  part.ignore({"filename"});
  part.finish();
  return node;
}

}  // namespace pharos::pbrt
