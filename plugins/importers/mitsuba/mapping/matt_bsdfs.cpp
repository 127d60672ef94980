// Diffuse materials and plastics.
#include "bsdfs.h"
#include "microfacets.h"
#include "refractive_indices.h"

namespace pharos::mitsuba {
namespace {

/// Maps the properties that `plastic` and `roughplastic` share.
ConfigNode plastic_of(Part& part, const char* type) {
  ConfigNode node = part.node(type);
  node.set("ior", relative_ior(part, kIorOfPolypropylene), part.where());
  node.set("reflectance", part.texture_or("diffuse_reflectance", 0.5), part.where());
  if (part.has("specular_reflectance")) {
    node.set("specular_reflectance", part.texture_or("specular_reflectance", 1), part.where());
  }
  part.copy_flag(node, "nonlinear");
  return node;
}

}  // namespace

ConfigNode map_diffuse(Part& part) {
  ConfigNode node = part.node("diffuse");
  node.set("reflectance", part.texture_or("reflectance", 0.5), part.where());
  return node;
}

ConfigNode map_rough_diffuse(Part& part) {
  ConfigNode node = part.node("rough_diffuse");
  node.set("reflectance", part.texture_or("reflectance", 0.5), part.where());
  node.set("alpha", part.texture_or("alpha", 0.2), part.where());
  part.copy_flag(node, "use_fast_approx");
  return node;
}

ConfigNode map_diffuse_transmitter(Part& part) {
  ConfigNode node = part.node("diffuse_transmitter");
  node.set("transmittance", part.texture_or("transmittance", 0.5), part.where());
  return node;
}

ConfigNode map_plastic(Part& part) {
  return plastic_of(part, "plastic");
}

ConfigNode map_rough_plastic(Part& part) {
  ConfigNode node = plastic_of(part, "rough_plastic");
  part.ignore({"sample_visible"});
  set_isotropic_roughness(part, node);
  return node;
}

ConfigNode map_phong(Part& part) {
  ConfigNode node = part.node("phong");
  node.set("diffuse_reflectance", part.texture_or("diffuse_reflectance", 0.5), part.where());
  node.set("specular_reflectance", part.texture_or("specular_reflectance", 0.2), part.where());
  node.set("exponent", part.texture_or("exponent", 30), part.where());
  node.set("rescale_to", number_node(0.99, part.where()), part.where());
  return node;
}

}  // namespace pharos::mitsuba
