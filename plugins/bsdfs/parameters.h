#pragma once

#include <string>
#include <utility>

#include <pharos/config/registry.h>
#include <pharos/config/schema.h>
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

/// Declares a texture that scales what is reflected or transmitted: 1 unless stated, never more.
template <class Settings>
void describe_factor(Schema<Settings>& s, std::string key, Ref<Texture> Settings::*member,
                     std::string help) {
  s.field(std::move(key), member, std::move(help))
      .otherwise("1")
      .check("at most 1 everywhere", [](const Ref<Texture>& t) { return t->maximum() <= 1; });
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

}  // namespace pharos
