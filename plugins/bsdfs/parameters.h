#pragma once

#include <string>
#include <utility>

#include <fmt/core.h>

#include <pharos/config/registry.h>
#include <pharos/config/schema.h>
#include <pharos/core/error.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// Refractive indices beyond it, and below its inverse, are refused: those of matter are far
/// within, and Fresnel's equations stay finite in single precision.
inline constexpr float kLargestIor = 100;

/// Declares `ior`, the index of an interface that light may meet from both sides.
template <class Settings>
void describe_ior(Schema<Settings>& s, std::string help) {
  s.field("ior", &Settings::ior, std::move(help)).at_least(0.01).at_most(kLargestIor);
}

/// Declares `ior`, the index of a coat.
template <class Settings>
void describe_coat_ior(Schema<Settings>& s) {
  s.field("ior", &Settings::ior, "Refractive index of the coat over that outside")
      .at_least(1)
      .at_most(kLargestIor);
}

/// Declares a texture of shares, which are never more than 1; `otherwise` is its default in YAML.
template <class Settings>
void describe_share(Schema<Settings>& s, std::string key, Ref<Texture> Settings::*member,
                    std::string help, std::string otherwise) {
  s.field(std::move(key), member, std::move(help))
      .otherwise(std::move(otherwise))
      .check("at most 1 everywhere",
             [](const Ref<Texture>& t) { return max_component(t->maximum()) <= 1; });
}

/// Declares `distribution` and `masking` of microfacets.
template <class Settings>
void describe_facets(Schema<Settings>& s) {
  s.field("distribution", &Settings::distribution, "How facets are tilted: GGX has longer tails");
  s.field("masking", &Settings::masking, "How masking and shadowing are combined");
}

/// Declares the microfacets of a surface that may be brushed, `alpha` and `alpha_v` among them.
template <class Settings>
void describe_brushed_facets(Schema<Settings>& s) {
  s.field("alpha", &Settings::alpha, "Roughness; along u, where alpha_v is given")
      .at_least(1e-4)
      .at_most(1);
  s.field("alpha_v", &Settings::alpha_v, "Roughness along v; without it as along u")
      .at_least(1e-4)
      .at_most(1);
  describe_facets(s);
}

/// Declares a texture that scales what is reflected or transmitted: 1 unless stated.
template <class Settings>
void describe_factor(Schema<Settings>& s, std::string key, Ref<Texture> Settings::*member,
                     std::string help) {
  describe_share(s, std::move(key), member, std::move(help), "1");
}

/// Declares the factors of an interface on either part of light; `onward` is what becomes of the
/// second, in a word.
template <class Settings>
void describe_both_factors(Schema<Settings>& s, const std::string& onward) {
  describe_factor(s, "specular_reflectance", &Settings::specular_reflectance,
                  "Factor on what is reflected");
  describe_factor(s, "specular_transmittance", &Settings::specular_transmittance,
                  "Factor on what is " + onward);
}

/// Throws InputError where two textures' largest values add up to more than 1 in a channel; `names`
/// tells the user what they are.
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
