// Maps artists' materials, and materials that are simplified.
#include <fmt/core.h>

#include "bsdfs.h"
#include "microfacets.h"
#include "refractive_indices.h"
#include "textures.h"

namespace pharos::mitsuba {
namespace {

constexpr double kIorOfPrincipled = 1.5;

/// Returns `color` times `factor` as a texture.
ConfigNode dimmed(Part& part, const ConfigNode& color, double factor) {
  ConfigNode node = part.node("scale");
  node.set("texture", color, part.where());
  node.set("factor", number_node(factor, part.where()), part.where());
  return node;
}

/// Maps a coat over a diffuse base to `plastic` or `rough_plastic`.
ConfigNode coated_diffuse(Part& part, const Object& base, bool is_rough) {
  Part matt(part.map(), base, part.sense());
  ConfigNode node = part.node(is_rough ? "rough_plastic" : "plastic");
  node.set("ior", relative_ior(part, kIorOfBk7), part.where());
  node.set("reflectance", matt.texture_or("reflectance", 0.5), base.where);
  node.set("nonlinear", text_node("true", part.where()), part.where());
  if (part.has("specular_reflectance")) {
    node.set("specular_reflectance", part.texture_or("specular_reflectance", 1), part.where());
  }
  if (is_rough) set_isotropic_roughness(part, node);
  return node;
}

}  // namespace

ConfigNode map_ward(Part& part) {
  ConfigNode node = part.node("ward");
  node.set("diffuse_reflectance", part.texture_or("diffuse_reflectance", 0.5), part.where());
  node.set("specular_reflectance", part.texture_or("specular_reflectance", 0.2), part.where());
  for (const char* key : {"alpha_u", "alpha_v"}) {
    node.set(key, number_node(part.average(key, 0.1), part.where()), part.where());
  }
  std::string variant = part.text("variant", "balanced");
  if (variant == "ward-duer") variant = "ward_duer";
  node.set("variant", text_node(variant, part.where()), part.where());
  return node;
}

ConfigNode map_principled(Part& part) {
  ConfigNode node = part.node("principled");
  node.set("base_color", part.texture_or("base_color", 0.5), part.where());
  node.set("roughness", part.texture_or("roughness", 0.5), part.where());
  for (const char* key : {"metallic", "spec_trans", "spec_tint", "sheen", "sheen_tint", "flatness",
                          "clearcoat", "clearcoat_gloss"}) {
    if (part.has(key)) node.set(key, part.texture_or(key, 0), part.where());
  }
  if (part.has("eta")) {
    node.set("ior", part.number_or("eta", kIorOfPrincipled), part.where());
  } else {
    node.set("specular", number_node(part.average("specular", 0.5), part.where()), part.where());
  }
  node.set("masking", text_node("separable", part.where()), part.where());
  part.ignore({"main_specular_sampling_rate", "clearcoat_sampling_rate",
               "diffuse_reflectance_sampling_rate"});
  return node;
}

/// Maps a pane to a blend of a diffuse and a clear part.
ConfigNode map_principled_thin(Part& part) {
  part.note("bsdf principledthin: replaced by a blend of diffuse_transmitter and thin_dielectric");
  const ConfigNode color = part.texture_or("base_color", 0.5);
  const double transmitted = part.average("diff_trans", 0) / 2;  // 0 to 2 in Mitsuba
  ConfigNode matt = part.node("diffuse_transmitter");
  matt.set("transmittance", dimmed(part, color, transmitted), part.where());
  matt.set("reflectance", dimmed(part, color, 1 - transmitted), part.where());
  ConfigNode clear = part.node("thin_dielectric");
  clear.set("ior", part.number_or("eta", kIorOfPrincipled), part.where());
  ConfigNode node = part.node("blend");
  node.set("first", std::move(matt), part.where());
  node.set("second", std::move(clear), part.where());
  node.set("weight", part.texture_or("spec_trans", 0), part.where());
  return node;
}

ConfigNode map_null(Part& part) {
  return part.node("pass_through");
}

ConfigNode map_coating(Part& part) {
  const bool is_rough = part.object().type == "roughcoating";
  const std::vector<const Object*> nested = part.children("bsdf");
  if (nested.size() == 1 && nested[0]->type == "diffuse") {
    part.note(fmt::format("bsdf {}: over a diffuse bsdf replaced by {}", part.object().type,
                          is_rough ? "rough_plastic" : "plastic"));
    return coated_diffuse(part, *nested[0], is_rough);
  }
  part.note(fmt::format("bsdf {}: the coat is left out", part.object().type));
  part.ignore({"int_ior", "ext_ior", "thickness", "sigma_a", "alpha", "distribution",
               "specular_reflectance"});
  return std::move(nested_bsdfs(part, 1, 1)[0]);
}

ConfigNode map_without_counterpart(Part& part) {
  throw InputError(part.where(),
                   fmt::format("bsdf '{}' has no counterpart in Pharos", part.object().type));
}

}  // namespace pharos::mitsuba
