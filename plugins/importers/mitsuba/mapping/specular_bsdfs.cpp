// Metals and glass.
#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "bsdfs.h"
#include "microfacets.h"
#include "refractive_indices.h"

namespace pharos::mitsuba {
namespace {

constexpr std::array kMeasuredHere{"Ag", "Al", "Au", "Cr", "Cu", "Fe", "Ni", "Ti"};
/// Further names of conductors in Mitsuba. Some have suffixes such as "_palik".
constexpr std::array kMeasuredThere{"a-C",  "AlAs", "AlSb", "Be",   "CsI", "Cu2O", "CuO", "d-C",
                                    "Hg",   "HgTe", "Ir",   "K",    "Li",  "MgO",  "Mo",  "Na",
                                    "Nb",   "Rh",   "Se",   "SiC",  "Si",  "SnTe", "Ta",  "Te",
                                    "ThF4", "TiC",  "TiN",  "TiO2", "VC",  "V",    "VN",  "W"};
constexpr double kNearlyVacuum = 1e-3;

template <class Names>
bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the metal in Pharos for a name in Mitsuba.
std::string known_metal(Part& part, const std::string& name) {
  if (name == "none") return "ideal";
  const std::string element = name.substr(0, name.find('_'));
  if (has(kMeasuredHere, element)) return element;
  if (!has(kMeasuredThere, element)) {
    std::vector<std::string> known(kMeasuredHere.begin(), kMeasuredHere.end());
    known.emplace_back("none");
    throw InputError(part.object().find("material")->where,
                     fmt::format("unknown metal '{}'{}; known: {}", one_line(name, 60),
                                 suggestion(name, known), quoted_list(known)));
  }
  part.note(fmt::format("bsdf {}: metal '{}' is replaced by chromium; state 'eta' and 'k'",
                        part.object().type, element));
  return "Cr";
}

/// Divides a spectrum, and raises components below `least` to it, with a note. Measurements by
/// spectrum may become negative in RGB.
Spectrum over(Part& part, const char* key, Spectrum value, double divisor, float least) {
  for (int i = 0; i < 3; ++i) {
    const auto component = static_cast<float>(double{value.value[i]} / divisor);
    if (component < least) {
      part.note(
          fmt::format("bsdf {}: '{}' is raised to at least {}", part.object().type, key, least));
    }
    value.value[i] = std::max(component, least);
  }
  return value;
}

void set_stated_metal(Part& part, ConfigNode& node) {
  const double outside = refractive_index(part, "ext_eta", 1);
  if (!(outside > 0)) throw InputError(part.where(), "'ext_eta' must be above 0");
  for (const char* key : {"eta", "k"}) {
    const std::optional<Spectrum> value = part.color(key);
    if (!value) {
      throw InputError(part.where(), fmt::format("{}: 'eta' and 'k' go together: '{}' is missing",
                                                 describe(part.object()), key));
    }
    const Location& there = part.object().find(key)->where;
    const float least = key == std::string_view("eta") ? 1e-4f : 0;
    node.set(key, color_node(over(part, key, *value, outside, least), there), there);
  }
  part.ignore({"material"});
}

void set_named_metal(Part& part, ConfigNode& node) {
  const bool is_old = part.map().document().dialect == Dialect::mitsuba_0;
  const std::string metal = known_metal(part, part.text("material", is_old ? "Cu" : "none"));
  const Property* stated = part.object().find("material");
  const Location& there = stated != nullptr ? stated->where : part.where();
  node.set("material", text_node(metal, there), there);
  if (std::abs(refractive_index(part, "ext_eta", 1) - 1) > kNearlyVacuum) {
    part.note(
        fmt::format("bsdf {}: 'ext_eta' is left out: the metal stands in air", part.object().type));
  }
}

ConfigNode metal_of(Part& part, const char* type) {
  ConfigNode node = part.node(type);
  if (part.has("eta") || part.has("k")) {
    set_stated_metal(part, node);
  } else {
    set_named_metal(part, node);
  }
  if (part.has("specular_reflectance")) {
    node.set("specular_reflectance", part.texture_or("specular_reflectance", 1), part.where());
  }
  return node;
}

ConfigNode glass_of(Part& part, const char* type) {
  ConfigNode node = part.node(type);
  node.set("ior", relative_ior(part, kIorOfBk7), part.where());
  for (const char* key : {"specular_reflectance", "specular_transmittance"}) {
    if (part.has(key)) node.set(key, part.texture_or(key, 1), part.where());
  }
  return node;
}

}  // namespace

ConfigNode map_conductor(Part& part) {
  return metal_of(part, "conductor");
}

ConfigNode map_rough_conductor(Part& part) {
  ConfigNode node = metal_of(part, "rough_conductor");
  part.ignore({"sample_visible"});
  set_roughness(part, node);
  return node;
}

ConfigNode map_dielectric(Part& part) {
  return glass_of(part, "dielectric");
}

ConfigNode map_thin_dielectric(Part& part) {
  return glass_of(part, "thin_dielectric");
}

ConfigNode map_rough_dielectric(Part& part) {
  ConfigNode node = glass_of(part, "rough_dielectric");
  part.ignore({"sample_visible"});
  set_roughness(part, node);
  return node;
}

}  // namespace pharos::mitsuba
