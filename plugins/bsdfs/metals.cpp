// material: the complex refractive index of a measured metal, for conductor and rough_conductor.
//
// The measurements of Ag, Au and Cu are from Johnson and Christy 1972 ("Optical Constants of the
// Noble Metals", Phys. Rev. B 6, 4370), of Cr, Fe, Ni and Ti from Johnson and Christy 1974
// ("Optical Constants of Transition Metals", Phys. Rev. B 9, 5056), and of Al from Rakic 1995
// ("Algorithm for the Determination of Intrinsic Optical Constants of Metal Films", Appl. Opt. 34,
// 4755), all as tabulated by refractiveindex.info.
//
// Each channel's eta and k are means over wavelength, weighted by the channel's response to
// daylight. The sum runs from 380 to 720 nm in steps of 10 nm, with linear interpolation of the
// measurements. The weights are the CIE 1931 color matching functions (fit of Wyman, Sloan and
// Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions") times
// illuminant D65, converted to linear Rec.709 and scaled to total weight one. The resulting
// reflectance at normal incidence matches a full spectral computation in daylight to within 0.013.
// The exception is gold, whose red lies outside the gamut of Rec.709 (0.98 instead of 1.03).
#include "metals.h"

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "fresnel.h"

namespace pharos {

ComplexIor metal_ior(Metal metal) {
  switch (metal) {
    case Metal::Ag:
      return {{0.056f, 0.055f, 0.043f}, {4.35f, 3.53f, 2.57f}};
    case Metal::Al:
      return {{1.473f, 0.986f, 0.598f}, {7.64f, 6.56f, 5.35f}};
    case Metal::Au:
      return {{0.064f, 0.497f, 1.460f}, {3.60f, 2.33f, 1.82f}};
    case Metal::Cr:
      return {{3.249f, 3.109f, 2.279f}, {3.29f, 3.34f, 3.12f}};
    case Metal::Cu:
      return {{0.179f, 1.041f, 1.290f}, {3.27f, 2.60f, 2.37f}};
    case Metal::Fe:
      return {{2.923f, 2.918f, 2.546f}, {3.07f, 2.94f, 2.75f}};
    case Metal::Ni:
      return {{2.021f, 1.902f, 1.724f}, {4.16f, 3.57f, 2.89f}};
    case Metal::Ti:
      return {{2.734f, 2.509f, 2.236f}, {3.82f, 3.40f, 3.01f}};
    case Metal::ideal:
      break;
  }
  return {Rgb(0), Rgb(1)};  // without a real part the metal absorbs nothing
}

ComplexIor stated_ior(std::optional<Metal> material, std::optional<Rgb> eta, std::optional<Rgb> k) {
  if (material && (eta || k)) {
    throw InputError("'material' and the refractive index 'eta', 'k' exclude each other");
  }
  if (eta.has_value() != k.has_value()) {
    throw InputError(fmt::format("'eta' and 'k' go together: '{}' is missing", eta ? "k" : "eta"));
  }
  return eta ? ComplexIor{*eta, *k} : metal_ior(material.value_or(Metal::Cu));
}

Rgb average_conductor_fresnel(const ComplexIor& ior) {
  // The mean of Schlick's approximation, in closed form.
  const Rgb normal_incidence = conductor_fresnel(1, ior.eta, ior.k);
  return normal_incidence + (Rgb(1) - normal_incidence) / 21;
}

}  // namespace pharos
