#include "media.h"

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

using PhaseMapper = ConfigNode (*)(Part&);

ConfigNode map_isotropic(Part& part) {
  return part.node("isotropic");
}

ConfigNode map_rayleigh(Part& part) {
  return part.node("rayleigh");
}

ConfigNode map_henyey_greenstein(Part& part) {
  const double g = part.number("g", 0.8);
  if (!(g > -1 && g < 1)) throw InputError(part.where(), "phase hg: 'g' must be above -1, below 1");
  ConfigNode node = part.node("henyey_greenstein");
  node.set("g", part.number_or("g", g), part.where());
  return node;
}

ConfigNode map_other_phase(Part& part) {
  for (const Property& p : part.object().properties) part.take(p.name);
  part.note(fmt::format("phase {}: isotropic scattering stands for it", part.object().type));
  return part.node("isotropic");
}

ConfigNode map_phase(SceneMap& scene, const Object& phase) {
  static const std::map<std::string_view, PhaseMapper> all{
      {"blendphase", map_other_phase}, {"hg", map_henyey_greenstein},
      {"isotropic", map_isotropic},    {"kkay", map_other_phase},
      {"microflake", map_other_phase}, {"mixturephase", map_other_phase},
      {"rayleigh", map_rayleigh},      {"sggx", map_other_phase},
      {"tabphase", map_other_phase}};
  return map_part(scene, phase, UvSense::same, "phase_function", mapper_of(all, phase));
}

std::optional<Rgb> coefficient(Part& part, const char* name) {
  const std::optional<Spectrum> value = part.color(name);
  if (!value) return std::nullopt;
  const Rgb c = value->value;
  if (c.r >= 0 && c.g >= 0 && c.b >= 0) return c;
  throw InputError(part.object().find(name)->where, fmt::format("'{}' must be at least 0", name));
}

ConfigNode rgb_node(Rgb c, const Location& where) {
  return triple_node({c.r, c.g, c.b}, where);
}

/// Returns the scattering and absorption coefficients. They are given directly, or as their sum and
/// the albedo, the share of scattering in the sum.
std::optional<std::pair<Rgb, Rgb>> coefficients(Part& part) {
  const auto scattering = coefficient(part, "sigma_s"), absorption = coefficient(part, "sigma_a"),
             sum = coefficient(part, "sigma_t"), share = coefficient(part, "albedo");
  if (scattering || absorption) return {{scattering.value_or(Rgb()), absorption.value_or(Rgb())}};
  const bool is_old = part.map().document().dialect == Dialect::mitsuba_0;
  if (is_old && !sum) return std::nullopt;
  const Rgb s = sum.value_or(Rgb(1)), albedo = share.value_or(Rgb(0.75f));
  return {{s * albedo, s * (Rgb(1) - albedo)}};
}

std::optional<ConfigNode> map_homogeneous(Part& part) {
  const auto stated = coefficients(part);
  if (!(part.number("scale", 1) >= 0)) {
    throw InputError(part.where(), "medium homogeneous: 'scale' must be at least 0");
  }
  part.ignore(
      {"material", "sample_emitters", "has_spectral_extinction", "strategy", "sampling_weight"});
  ConfigNode node = part.node("homogeneous");
  if (const Object* phase = part.child("phase")) {
    node.set("phase", map_phase(part.map(), *phase), phase->where);
  }
  if (!stated) return std::nullopt;  // one of the named materials of 0.x
  node.set("scattering", rgb_node(stated->first, part.where()), part.where());
  node.set("absorption", rgb_node(stated->second, part.where()), part.where());
  if (part.has("scale")) node.set("scale", part.number_or("scale", 1), part.where());
  return node;
}

std::optional<ConfigNode> map_heterogeneous(Part& part) {
  for (const Property& p : part.object().properties) part.take(p.name);
  return std::nullopt;
}

using Mapper = std::optional<ConfigNode> (*)(Part&);

std::optional<ConfigNode> map_parameters(SceneMap& scene, const Object& medium) {
  static const std::map<std::string_view, Mapper> all{{"heterogeneous", map_heterogeneous},
                                                      {"homogeneous", map_homogeneous}};
  const Mapper mapper = mapper_of(all, medium);
  SceneMap::Entry entry(scene, medium);
  Part part(scene, medium);
  std::optional<ConfigNode> node = mapper(part);
  part.finish();
  if (node) entry.done("medium homogeneous");
  return node;
}

}  // namespace

std::optional<ConfigNode> map_medium(SceneMap& scene, const Object& medium) {
  const auto& names = scene.media().names;
  if (const auto known = names.find({&medium, UvSense::same}); known != names.end()) {
    return text_node(known->second, medium.where);
  }
  std::optional<ConfigNode> node = map_parameters(scene, medium);
  if (!node) {
    scene.note(medium.where, fmt::format("medium {}: left out, light passes freely", medium.type));
    return std::nullopt;
  }
  const std::string name =
      scene.name_in(scene.media(), medium, UvSense::same, [&] { return std::move(*node); });
  return text_node(name, medium.where);
}

}  // namespace pharos::mitsuba
