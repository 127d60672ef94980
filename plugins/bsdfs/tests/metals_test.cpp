#include "../metals.h"

#include <string>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "../fresnel.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

Rgb normal_reflectance(Metal metal) {
  const ComplexIor ior = metal_ior(metal);
  return conductor_fresnel(1, ior.eta, ior.k);
}

/// Builds a BSDF from YAML and returns the error message.
std::string complaint(const std::string& yaml) {
  try {
    test::build(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("metals: the colors of their spectra in daylight") {
  // The reflectance at normal incidence in linear Rec.709, computed wavelength by wavelength.
  struct Color {
    Metal metal;
    Rgb spectral;
  };
  const Color colors[] = {
      {Metal::Ag, {0.989f, 0.984f, 0.978f}}, {Metal::Al, {0.908f, 0.916f, 0.922f}},
      {Metal::Au, {1.035f, 0.730f, 0.364f}}, {Metal::Cr, {0.550f, 0.556f, 0.554f}},
      {Metal::Cu, {0.929f, 0.624f, 0.522f}}, {Metal::Fe, {0.529f, 0.513f, 0.494f}},
      {Metal::Ni, {0.696f, 0.641f, 0.563f}}, {Metal::Ti, {0.618f, 0.580f, 0.542f}}};
  for (const Color& color : colors) {
    CAPTURE(static_cast<int>(color.metal));
    const Rgb found = normal_reflectance(color.metal);
    for (int c = 0; c < 3; ++c) {
      const bool gold_red = color.metal == Metal::Au && c == 0;
      CHECK(std::abs(found[c] - color.spectral[c]) < (gold_red ? 0.06f : 0.013f));
      CHECK(found[c] < 1);
    }
  }
}

TEST_CASE("metals: the ideal one reflects everything at every angle") {
  const ComplexIor ideal = metal_ior(Metal::ideal);
  for (const float cosine : {1.0f, 0.7f, 0.2f, 1e-3f, 1e-20f, 0.0f}) {
    CHECK(conductor_fresnel(cosine, ideal.eta, ideal.k) == Rgb(1));
  }
  CHECK(average_conductor_fresnel(ideal) == Rgb(1));
}

TEST_CASE("metals: the mean over the hemisphere") {
  for (const auto& entry : EnumNames<Metal>::names) {
    CAPTURE(entry.first);
    const ComplexIor ior = metal_ior(entry.second);
    double sum = 0;
    constexpr int kPoints = 1000;  // points of the squared cosine, which is uniform
    for (int i = 0; i < kPoints; ++i) {
      const float cosine = std::sqrt((static_cast<float>(i) + 0.5f) / kPoints);
      sum += double{mean(conductor_fresnel(cosine, ior.eta, ior.k))} / kPoints;
    }
    CHECK(mean(average_conductor_fresnel(ior)) == doctest::Approx(sum).epsilon(0.02));
  }
}

TEST_CASE("metals: a name, or both parts of an index, or copper") {
  const ComplexIor named = stated_ior(Metal::Au, {}, {}), given = stated_ior({}, Rgb(2), Rgb(3));
  CHECK(named.k == metal_ior(Metal::Au).k);
  CHECK(given.eta == Rgb(2));
  CHECK(given.k == Rgb(3));
  CHECK(stated_ior({}, {}, {}).eta == metal_ior(Metal::Cu).eta);
}

TEST_CASE("metals: anything else is refused where it stands") {
  for (const std::string type : {"conductor", "rough_conductor"}) {
    CAPTURE(type);
    const auto with = [&](const std::string& rest) {
      return complaint("{ type: " + type + rest + " }");
    };
    CHECK(with("").empty());
    CHECK(with(", material: Ni").empty());
    CHECK(with(", eta: 1, k: [1, 2, 3]").empty());
    const std::string both = with(", material: Al, eta: 1, k: 2");
    CHECK(mentions(both, "exclude each other"));
    CHECK(mentions(both, "test:1"));
    CHECK(mentions(with(", material: Al, k: 2"), "exclude each other"));
    CHECK(mentions(with(", eta: 1"), "'k' is missing"));
    CHECK(mentions(with(", k: 1"), "'eta' is missing"));
    CHECK(mentions(with(", material: Unobtainium"), "Unobtainium"));
    CHECK(mentions(with(", eta: 0, k: 1"), "eta"));
    CHECK(mentions(with(", eta: 1, k: [1, -1, 1]"), "k"));
    CHECK(mentions(with(", specular_reflectance: 1.5"), "specular_reflectance"));
  }
}

}  // namespace pharos
