// The configuration of materials, especially of nested ones.

#include <string>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "bsdf_checks.h"

namespace pharos {

using test::build;
using test::registry;

TEST_CASE("materials: nested in place or by name") {
  BuildContext context{registry()};
  const Ref<Bsdf> brass = build("{ type: rough_conductor, alpha: 0.2 }");
  context.named.push_back({"bsdf", "brass", brass});
  const Ref<Bsdf> bsdf = build(
      "{ type: mask, opacity: 1, bsdf: { type: two_sided, bsdf: brass, "
      "back: { type: blend, first: brass, second: { type: rough_plastic, alpha: 0.4 } } } }",
      context);
  CHECK(bsdf->roughness({}) == 0.2f);
  const Vec3 wo = test::direction(20, 0), wi = test::direction(30, 170);
  CHECK(bsdf->evaluate({}, wo, wi, {}).value == brass->evaluate({}, wo, wi, {}).value);
}

TEST_CASE("materials: defaults are matt") {
  CHECK(build("two_sided")->albedo({}) == Rgb(0.5f));
  CHECK(build("mask")->albedo({}) == Rgb(0.75f));
  CHECK(build("diffuse_transmitter")->albedo({}) == Rgb(0.5f));
  // Defaults do not change if the scene has a material of the same name.
  BuildContext context{registry()};
  context.named.push_back({"bsdf", "diffuse", build("rough_conductor")});
  CHECK(build("two_sided", context)->albedo({}) == Rgb(0.5f));
}

TEST_CASE("materials: finite at the ends of the ranges of refractive indices") {
  for (const char* yaml :
       {"{ type: conductor, eta: 1e-4, k: 0 }", "{ type: conductor, eta: 1e4, k: 1e4 }",
        "{ type: rough_conductor, eta: 1e-4, k: 1e4 }", "{ type: dielectric, ior: 0.01 }",
        "{ type: dielectric, ior: 100 }", "{ type: rough_dielectric, ior: 0.01 }",
        "{ type: rough_dielectric, ior: 100 }", "{ type: thin_dielectric, ior: 0.01 }",
        "{ type: thin_dielectric, ior: 100 }",
        "{ type: plastic, ior: 100, reflectance: 1, nonlinear: true }",
        "{ type: rough_plastic, ior: 100, reflectance: 1, nonlinear: true }",
        "{ type: principled, ior: 0.01, spec_trans: 0.5 }",
        "{ type: principled, ior: 100, spec_tint: 1, base_color: [0, 0, 1], roughness: 0 }",
        "{ type: principled, ior: 1.001, spec_trans: 1, roughness: 0 }",
        "{ type: phong, exponent: 1e5 }"}) {
    CAPTURE(yaml);
    const Ref<Bsdf> bsdf = build(yaml);
    CHECK(is_finite(bsdf->albedo({})));
    CHECK(max_component(bsdf->albedo({})) <= 1.0001f);
    for (const double theta : {0.0, 60.0, 89.9, 100.0, 180.0}) {
      test::check_samples(*bsdf, test::direction(theta, 30), {});
    }
  }
}

TEST_CASE("materials: wrong settings say what is wrong, and where") {
  const auto fails = [](const std::string& yaml, const char* message) {
    CAPTURE(yaml);
    CHECK_THROWS_WITH_AS(build(yaml), message, InputError);
  };
  fails("{ type: two_sided, back: { type: mask } }",
        "test:1:1: error: back must be opaque, but 'mask' lets light through");
  fails("{ type: two_sided, bsdf: { type: dielectric } }",
        "test:1:1: error: bsdf must be opaque, but 'dielectric' lets light through");
  fails("{ type: diffuse_transmitter, reflectance: 0.8 }",
        "test:1:1: error: transmittance and reflectance must not add up to more than 1, but their "
        "largest values are 0.5 and 0.8");
  fails("{ type: mask, opacity: 1.5 }",
        "test:1:24: error: opacity must be at most 1 everywhere, got 1.5");
  fails("{ type: dielectric, ior: 1e-20 }", "test:1:26: error: ior must be >= 0.01, got 1e-20");
  fails("{ type: rough_plastic, ior: 1e20 }", "test:1:29: error: ior must be <= 100, got 1e20");
  fails("{ type: plastic, ior: 0.9 }", "test:1:23: error: ior must be >= 1, got 0.9");
  fails("{ type: rough_plastic, alpha: 0 }", "test:1:31: error: alpha must be >= 0.0001, got 0");
  fails("{ type: rough_diffuse, alpha: 1.1 }",
        "test:1:31: error: alpha must be at most 1 everywhere, got 1.1");
  fails("{ type: phong, diffuse_reflectance: 0.7, specular_reflectance: [0.1, 0.4, 0] }",
        "test:1:1: error: diffuse_reflectance and specular_reflectance, without rescale_to, must "
        "not add up to more than 1, but their largest values are 0.7 and 0.4");
  fails("{ type: phong, exponent: 2e5 }",
        "test:1:26: error: exponent must be in [0, 1e5] everywhere, got 2e5");
  fails("{ type: principled, ior: 1.4, specular: 0.3 }",
        "test:1:1: error: 'ior' and 'specular' exclude each other");
  fails("{ type: principled, specular: 0, spec_trans: 0.5 }",
        "test:1:1: error: where 'spec_trans' lets light through, the refractive index must differ "
        "from 1 by at least 0.001, but it is 1");
  fails("{ type: two_sided, bsdf: { type: principled, spec_trans: 0.1 } }",
        "test:1:1: error: bsdf must be opaque, but 'principled' lets light through");
  CHECK_THROWS_WITH_AS(build("{ type: blend, first: { type: diffuse } }"),
                       doctest::Contains("'second'"), InputError);
}

}  // namespace pharos
