// Opaque materials of pbrt reflect on both sides of a surface, hence `two_sided`.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "mapping.h"
#include "named_spectra.h"
#include "part.h"

namespace pharos::pbrt {
namespace {

/// pbrt treats microfacet surfaces below this alpha as smooth.
constexpr double kSmooth = 1e-3;
constexpr double kLeastAlpha = 1e-4;

ConfigNode on_both_sides(Part& part, ConfigNode bsdf) {
  ConfigNode node = part.node("two_sided");
  node.set("bsdf", std::move(bsdf), part.where());
  return node;
}

/// The alphas of a rough surface along u and v.
struct Roughness {
  double u = 0, v = 0;
  bool is_smooth() const { return u < kSmooth && v < kSmooth; }
};

/// Reads `roughness`, `uroughness` and `vroughness`, whose names begin with `prefix`. By default
/// alpha is the root of the roughness.
Roughness read_roughness(Part& part, const std::string& prefix = "") {
  const double both = part.average(prefix + "roughness", 0);
  const double u = part.average(prefix + "uroughness", both);
  const double v = part.average(prefix + "vroughness", both);
  const bool is_mapped = part.flag("remaproughness", true);
  const auto alpha = [&](double roughness) {
    const double stated = std::max(0.0, roughness);
    return std::min(1.0, is_mapped ? std::sqrt(stated) : stated);
  };
  return {alpha(u), alpha(v)};
}

void set_alpha(Part& part, ConfigNode& node, const Roughness& roughness) {
  const auto alpha = [](double a) { return std::max(a, kLeastAlpha); };
  node.set("alpha", number_node(alpha(roughness.u), part.where()), part.where());
  if (roughness.u == roughness.v) return;
  node.set("alpha_v", number_node(alpha(roughness.v), part.where()), part.where());
}

/// Reads a refractive index: a number, or a spectrum as its mean.
double read_index(Part& part, const std::string& name, double otherwise) {
  if (!part.has(name)) return otherwise;
  const std::optional<Color> color = part.color(name, ColorRole::surface);
  if (!color->is_gray) part.note(fmt::format("'{}' is the same at all wavelengths", name));
  const double index = double{color->is_gray ? color->value.r : mean(color->value)};
  if (!(index >= 0.01 && index <= 100)) {
    throw InputError(part.where(name), fmt::format("'{}' must be between 0.01 and 100", name));
  }
  return index;
}

ConfigNode map_diffuse(Part& part) {
  ConfigNode node = part.node("diffuse");
  node.set("reflectance", part.texture_or("reflectance", 0.5), part.where());
  return on_both_sides(part, std::move(node));
}

ConfigNode map_coated_diffuse(Part& part) {
  const Roughness roughness = read_roughness(part);
  ConfigNode node = part.node(roughness.is_smooth() ? "plastic" : "rough_plastic");
  if (!roughness.is_smooth()) {
    const double alpha = std::sqrt(roughness.u * roughness.v);
    if (roughness.u != roughness.v) part.note("the coat is equally rough along u and v");
    set_alpha(part, node, {alpha, alpha});
  }
  node.set("ior", number_node(std::max(1.0, read_index(part, "eta", 1.5)), part.where()),
           part.where());
  node.set("reflectance", part.texture_or("reflectance", 0.5), part.where());
  node.set("nonlinear", text_node("true", part.where()), part.where());
  part.note(
      "light between coat and base is summed in closed form, without refraction by rough "
      "facets");
  if (part.has("albedo")) part.note("the medium in the coat is left out");
  part.ignore({"thickness", "g", "albedo", "maxdepth", "nsamples"});
  return on_both_sides(part, std::move(node));
}

/// Sets the complex index of refraction, given by `eta` and `k` or by the reflectance at normal
/// incidence.
void set_metal(Part& part, ConfigNode& node, const std::string& prefix) {
  if (part.has("reflectance")) {
    // pbrt's index with this reflectance and eta = 1: k = 2 sqrt(r / (1 - r)).
    const std::optional<Color> color = part.find("reflectance")->type == "texture"
                                           ? std::nullopt
                                           : part.color("reflectance", ColorRole::surface);
    const double mean = color ? 0 : part.average("reflectance", 0.5);
    Rgb k;
    for (int c = 0; c < 3; ++c) {
      const double r = std::clamp(color ? double{color->value[c]} : mean, 0.0, 0.9999);
      k[c] = static_cast<float>(2 * std::sqrt(r / (1 - r)));
    }
    node.set("eta", number_node(1, part.where()), part.where());
    node.set("k", rgb_node(k, part.where()), part.where());
    return;
  }
  const std::string eta_name = prefix + "eta", k_name = prefix + "k";
  const std::optional<Color> eta = part.color(eta_name, ColorRole::surface);
  const std::optional<Color> k = part.color(k_name, ColorRole::surface);
  node.set("eta",
           color_node(eta.value_or(Color{.value = *named_spectrum("metal-Cu-eta")}),
                      part.where(eta_name)),
           part.where(eta_name));
  node.set(
      "k",
      color_node(k.value_or(Color{.value = *named_spectrum("metal-Cu-k")}), part.where(k_name)),
      part.where(k_name));
}

ConfigNode metal(Part& part, const std::string& prefix) {
  const Roughness roughness = read_roughness(part, prefix);
  ConfigNode node = part.node(roughness.is_smooth() ? "conductor" : "rough_conductor");
  if (!roughness.is_smooth()) set_alpha(part, node, roughness);
  set_metal(part, node, prefix);
  return on_both_sides(part, std::move(node));
}

ConfigNode map_conductor(Part& part) {
  return metal(part, "");
}

ConfigNode map_coated_conductor(Part& part) {
  part.note("the coat is left out");
  part.ignore({"interface.roughness", "interface.uroughness", "interface.vroughness",
               "interface.eta", "thickness", "g", "albedo", "maxdepth", "nsamples"});
  return metal(part, "conductor.");
}

ConfigNode map_dielectric(Part& part) {
  const Roughness roughness = read_roughness(part);
  ConfigNode node = part.node(roughness.is_smooth() ? "dielectric" : "rough_dielectric");
  if (!roughness.is_smooth()) set_alpha(part, node, roughness);
  node.set("ior", number_node(read_index(part, "eta", 1.5), part.where("eta")), part.where("eta"));
  return node;
}

ConfigNode map_thin_dielectric(Part& part) {
  ConfigNode node = part.node("thin_dielectric");
  node.set("ior", number_node(read_index(part, "eta", 1.5), part.where("eta")), part.where("eta"));
  return node;
}

ConfigNode map_diffuse_transmission(Part& part) {
  constexpr double kDefault = 0.25;
  ConfigNode node = part.node("diffuse_transmitter");
  const double scale = part.number("scale", 1);
  for (const char* key : {"reflectance", "transmittance"}) {
    ConfigNode value = part.texture_or(key, kDefault);
    if (scale != 1) {
      ConfigNode scaled = part.node("scale");
      scaled.set("texture", std::move(value), part.where(key));
      scaled.set("factor", number_node(scale, part.where("scale")), part.where("scale"));
      value = std::move(scaled);
    }
    node.set(key, std::move(value), part.where(key));
  }
  return node;
}

ConfigNode map_interface(Part& part) {
  return part.node("pass_through");
}

ConfigNode map_mix(Part& part) {
  const Parameter* both = part.find("materials");
  if (both == nullptr || both->texts.size() != 2) {
    throw InputError(part.where("materials"), "Material mix: 'materials' must be two names");
  }
  part.ignore({"materials"});
  ConfigNode node = part.node("blend");
  const char* const keys[] = {"first", "second"};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string entry = part.scene().material(both->texts[i], both->where);
    node.set(keys[i], text_node(entry, both->where), both->where);
  }
  node.set("weight", part.texture_or("amount", 0.5, 1, TextureKind::number), part.where("amount"));
  return node;
}

/// Stands for scattering below the surface.
ConfigNode map_subsurface(Part& part) {
  part.note("scattering below the surface is left out: a diffuse surface under a clear coat");
  part.ignore_all();
  ConfigNode node = part.node("plastic");
  node.set("nonlinear", text_node("true", part.where()), part.where());
  return on_both_sides(part, std::move(node));
}

/// Stands for materials that Pharos does not have.
ConfigNode map_other(Part& part) {
  part.note("replaced by a diffuse material of reflectance 0.5");
  part.ignore_all();
  return on_both_sides(part, part.node("diffuse"));
}

using Mapper = ConfigNode (*)(Part&);

/// Puts the maps of normals and heights around a material.
ConfigNode with_relief(Part& part, ConfigNode node) {
  if (part.has("normalmap")) {
    ConfigNode image = part.node("bitmap");
    image.set("file", part.file("normalmap"), part.where("normalmap"));
    image.set("color_space", text_node("linear", part.where()), part.where());
    ConfigNode around = part.node("normal_map");
    around.set("texture", std::move(image), part.where("normalmap"));
    around.set("bsdf", std::move(node), part.where());
    return around;
  }
  if (part.has("displacement")) {
    ConfigNode around = part.node("bump_map");
    around.set("texture", part.texture_or("displacement", 0, 1e30, TextureKind::number),
               part.where("displacement"));
    around.set("bsdf", std::move(node), part.where());
    return around;
  }
  return node;
}

}  // namespace

ConfigNode map_material(Scene& scene, const Statement& material) {
  static const std::map<std::string_view, Mapper> all{
      {"", map_interface},
      {"coatedconductor", map_coated_conductor},
      {"coateddiffuse", map_coated_diffuse},
      {"conductor", map_conductor},
      {"dielectric", map_dielectric},
      {"diffuse", map_diffuse},
      {"diffusetransmission", map_diffuse_transmission},
      {"hair", map_other},
      {"interface", map_interface},
      {"measured", map_other},
      {"mix", map_mix},
      {"none", map_interface},
      {"subsurface", map_subsurface},
      {"thindielectric", map_thin_dielectric}};
  // MakeNamedMaterial has a name first and its type among the parameters.
  Statement typed = material;
  std::string what = "material";
  if (material.word == "MakeNamedMaterial") {
    const Parameter* type = find(material.parameters, "type");
    if (type == nullptr || type->type != "string" || type->texts.size() != 1) {
      throw InputError(material.where, fmt::format("MakeNamedMaterial '{}': 'type' is missing",
                                                   one_line(material.type(), 60)));
    }
    typed.texts = {type->texts.front()};
    what = fmt::format("material '{}'", one_line(material.type(), 60));
  }
  const std::size_t object =
      scene.log().add_object(material.where, fmt::format("{} {}", what, typed.type()));
  Part part(scene, typed, "material");
  part.ignore({"type"});
  ConfigNode node = mapper_of(all, typed)(part);
  const bool is_two_sided = node.find("type")->text() == "two_sided";
  const ConfigNode& inner = is_two_sided ? *node.find("bsdf") : node;
  scene.log().stands(object, "bsdf " + inner.find("type")->text());
  node = with_relief(part, std::move(node));
  part.finish();
  return node;
}

}  // namespace pharos::pbrt
