#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/core/rgb.h>

namespace pharos {

/// Metals of known refractive index. See metals.cpp for the sources of the numbers.
enum class Metal { Ag, Al, Au, Cr, Cu, Fe, Ni, Ti, ideal };
template <>
struct EnumNames<Metal> {
  static constexpr auto names = std::to_array<EnumName<Metal>>({{"Ag", Metal::Ag},
                                                                {"Al", Metal::Al},
                                                                {"Au", Metal::Au},
                                                                {"Cr", Metal::Cr},
                                                                {"Cu", Metal::Cu},
                                                                {"Fe", Metal::Fe},
                                                                {"Ni", Metal::Ni},
                                                                {"Ti", Metal::Ti},
                                                                {"ideal", Metal::ideal}});
};

/// A complex index of refraction eta - i k relative to vacuum, in linear Rec.709 channels.
struct ComplexIor {
  Rgb eta, k;
};

/// The index of `metal`. The ideal metal reflects everything at every angle.
ComplexIor metal_ior(Metal metal);

/// Returns the index stated by the parameters of describe_metal(): the index of a named metal, or
/// `eta` and `k` together, or copper if nothing is given. Throws InputError for any other
/// combination.
ComplexIor stated_ior(std::optional<Metal> material, std::optional<Rgb> eta, std::optional<Rgb> k);

/// The approximate mean reflectance over the cosine-weighted hemisphere of incident directions [1].
Rgb average_conductor_fresnel(const ComplexIor& ior);

/// Declares the parameters `material`, `eta` and `k` of a metallic BSDF. Their ranges extend far
/// beyond real metals; within them conductor_fresnel() neither overflows nor becomes 0 / 0.
template <class Settings>
void describe_metal(Schema<Settings>& s) {
  s.field("material", &Settings::material,
          "Measured metal; Cu if neither it nor eta and k are given");
  s.field("eta", &Settings::eta, "Real part of the refractive index; needs k and excludes material")
      .at_least(1e-4)
      .at_most(1e4);
  s.field("k", &Settings::k,
          "Imaginary part of the refractive index; needs eta and excludes material")
      .at_least(0)
      .at_most(1e4);
}

}  // namespace pharos
