#include <fmt/core.h>

#include "mapping.h"
#include "part.h"

namespace pharos::pbrt {
namespace {

constexpr Rgb kAbsorption{0.0011f, 0.0024f, 0.014f}, kScattering{2.55f, 3.21f, 3.77f};

void set_coefficient(Part& part, ConfigNode& node, const char* key, const char* name,
                     Rgb otherwise) {
  const std::optional<Color> stated = part.color(name, ColorRole::surface);
  const Rgb value = stated ? stated->value : otherwise;
  if (!(value.r >= 0 && value.g >= 0 && value.b >= 0)) {
    throw InputError(part.where(name), fmt::format("'{}' must be at least 0", name));
  }
  node.set(key, rgb_node(value, part.where(name)), part.where(name));
}

std::optional<ConfigNode> map_homogeneous(Part& part) {
  ConfigNode node = part.node("homogeneous");
  if (part.text("preset")) part.note("'preset' is left out, coefficients are pbrt's defaults");
  set_coefficient(part, node, "absorption", "sigma_a", kAbsorption);
  set_coefficient(part, node, "scattering", "sigma_s", kScattering);
  const double scale = part.number("scale", 1), g = part.number("g", 0);
  if (!(scale >= 0)) throw InputError(part.where("scale"), "'scale' must be at least 0");
  if (!(g > -1 && g < 1)) throw InputError(part.where("g"), "'g' must be above -1 and below 1");
  if (scale != 1) node.set("scale", number_node(scale, part.where("scale")), part.where("scale"));
  if (g != 0) {
    ConfigNode phase = part.node("henyey_greenstein");
    phase.set("g", number_node(g, part.where("g")), part.where("g"));
    node.set("phase", std::move(phase), part.where());
  }
  if (part.has("Le")) part.note("emission is left out");
  part.ignore({"Le", "Lescale"});
  return node;
}

/// Media that vary in space.
std::optional<ConfigNode> leave_out(Part& part) {
  part.note("left out, light passes freely");
  part.ignore_all();
  return std::nullopt;
}

using Mapper = std::optional<ConfigNode> (*)(Part&);

}  // namespace

void map_medium(Scene& scene, const Statement& medium) {
  static const std::map<std::string_view, Mapper> all{{"cloud", leave_out},
                                                      {"homogeneous", map_homogeneous},
                                                      {"nanovdb", leave_out},
                                                      {"rgbgrid", leave_out},
                                                      {"uniformgrid", leave_out}};
  // The first text is the name, and the type is a parameter.
  Part named(scene, medium, "medium");
  Statement typed = medium;
  typed.texts = {named.text("type").value_or("homogeneous")};
  const std::size_t object = scene.log().add_object(
      medium.where, fmt::format("medium {} '{}'", typed.type(), medium.type()));
  Part part(scene, typed, "medium");
  part.ignore({"type"});
  std::optional<ConfigNode> node = mapper_of(all, typed)(part);
  part.finish();
  if (node) scene.log().stands(object, "medium homogeneous");
  scene.define_medium(medium.type(), medium.where, std::move(node));
}

}  // namespace pharos::pbrt
