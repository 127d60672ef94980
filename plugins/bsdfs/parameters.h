#pragma once

#include <string>
#include <utility>

#include <fmt/core.h>

#include <pharos/config/registry.h>
#include <pharos/config/schema.h>
#include <pharos/core/error.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// Refractive indices above this value or below its inverse are rejected. Indices of real matter
/// lie far within this range, and in it Fresnel's equations stay finite in single precision.
inline constexpr float kLargestIor = 100;

/// Declares `ior`, the index of an interface that light may meet from either side.
template <class Settings>
void describe_ior(Schema<Settings>& s, std::string help) {
  s.field("ior", &Settings::ior, std::move(help)).at_least(0.01).at_most(kLargestIor);
}

/// Declares `ior`, the index of a coat.
template <class Settings>
void describe_coat_ior(Schema<Settings>& s) {
  s.field("ior", &Settings::ior, "Refractive index of the coat over the index outside")
      .at_least(1)
      .at_most(kLargestIor);
}

/// Declares a texture of shares, at most 1 everywhere; `otherwise` is its default in YAML.
template <class Settings>
void describe_share(Schema<Settings>& s, std::string key, Ref<Texture> Settings::*member,
                    std::string help, std::string otherwise) {
  s.field(std::move(key), member, std::move(help))
      .otherwise(std::move(otherwise))
      .check("at most 1 everywhere",
             [](const Ref<Texture>& t) { return max_component(t->maximum()) <= 1; });
}

/// Declares `distribution` and `masking` of a microfacet surface.
template <class Settings>
void describe_facets(Schema<Settings>& s) {
  s.field("distribution", &Settings::distribution,
          "Distribution of facet normals; GGX has longer tails than Beckmann");
  s.field("masking", &Settings::masking, "How masking and shadowing are combined");
}

/// Declares the parameters of an anisotropic microfacet surface, including `alpha` and `alpha_v`.
template <class Settings>
void describe_brushed_facets(Schema<Settings>& s) {
  s.field("alpha", &Settings::alpha, "Roughness; only along u if alpha_v is given")
      .at_least(1e-4)
      .at_most(1);
  s.field("alpha_v", &Settings::alpha_v, "Roughness along v; by default equal to alpha")
      .at_least(1e-4)
      .at_most(1);
  describe_facets(s);
}

/// Declares a texture that scales reflected or transmitted light, by default 1.
template <class Settings>
void describe_factor(Schema<Settings>& s, std::string key, Ref<Texture> Settings::*member,
                     std::string help) {
  describe_share(s, std::move(key), member, std::move(help), "1");
}

/// Declares the factors of an interface on its two parts of light. `onward` describes the second
/// part in a word.
template <class Settings>
void describe_both_factors(Schema<Settings>& s, const std::string& onward) {
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what is reflected");
  describe_factor(s, "specular_transmittance", &Settings::specular_transmittance,
                  "Factor on what is " + onward);
}

/// Throws InputError if the largest values of two textures add up to more than 1 in a channel.
/// `names` names both textures in the error message.
inline void check_sum(const Texture& a, const Texture& b, const char* names) {
  const Rgb largest_a = a.maximum(), largest_b = b.maximum();
  for (int c = 0; c < 3; ++c) {
    if (largest_a[c] + largest_b[c] <= 1) continue;
    throw InputError(
        fmt::format("{} must not add up to more than 1, but their largest values are {:.4g} and "
                    "{:.4g}",
                    names, largest_a[c], largest_b[c]));
  }
}

}  // namespace pharos
