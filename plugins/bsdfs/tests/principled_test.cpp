#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "bsdf_checks.h"

namespace pharos {
namespace {

Ref<Bsdf> principled(const std::string& settings) {
  return test::build("{ type: principled, " + settings + " }");
}

const Vec3 kOut = test::direction(35, 20), kIn = test::direction(65, 110);

Rgb value(const Ref<Bsdf>& bsdf, Vec3 wo = kOut, Vec3 wi = kIn, ScatterOptions options = {}) {
  return bsdf->evaluate({}, wo, wi, options).value;
}

void check_value(const std::string& settings, double r, double g, double b) {
  CAPTURE(settings);
  const Rgb found = value(principled("base_color: [0.8, 0.5, 0.2], roughness: 0.6" + settings));
  CHECK(found.r == doctest::Approx(r).epsilon(1e-4));
  CHECK(found.g == doctest::Approx(g).epsilon(1e-4));
  CHECK(found.b == doctest::Approx(b).epsilon(1e-4));
}

double weight(double cosine) {
  return std::pow(1 - cosine, 5);
}

}  // namespace

TEST_CASE("principled: without an interface the matt lobe alone") {
  const Vec3 m = normalize(kOut + kIn);
  const double cos_d = dot(m, kIn), r = 2 * 0.6 * cos_d * cos_d;
  const double o = weight(kOut.z), i = weight(kIn.z);
  const double expected =
      0.5 / M_PI * kIn.z * ((1 - o / 2) * (1 - i / 2) + r * (o + i + o * i * (r - 1)));
  CHECK(value(principled("specular: 0, roughness: 0.6, base_color: 0.5")).g ==
        doctest::Approx(expected).epsilon(1e-5));
}

TEST_CASE("principled: a metal is Schlick's Fresnel on GGX facets") {
  const Vec3 m = normalize(kOut + kIn);
  for (const double roughness : {0.3, 0.7, 1.0}) {
    const double alpha = roughness * roughness, w = weight(dot(m, kIn));
    const double o = test::smith_lambda(kOut, alpha), i = test::smith_lambda(kIn, alpha);
    const double facets = test::ggx(m, alpha) / (4 * kOut.z);
    const std::string settings =
        "metallic: 1, base_color: [0.9, 0.5, 0.1], roughness: " + std::to_string(roughness);
    const Rgb joint = value(principled(settings));
    const Rgb separable = value(principled(settings + ", masking: separable"));
    CHECK(joint.r == doctest::Approx((0.9 + 0.1 * w) * facets / (1 + o + i)).epsilon(1e-4));
    CHECK(joint.b == doctest::Approx((0.1 + 0.9 * w) * facets / (1 + o + i)).epsilon(1e-4));
    CHECK(separable.g ==
          doctest::Approx((0.5 + 0.5 * w) * facets / ((1 + o) * (1 + i))).epsilon(1e-4));
  }
}

TEST_CASE("principled: values of each lobe, evaluated apart") {
  check_value("", 0.111627, 0.0704705, 0.0293141);
  check_value(", spec_tint: 0.6", 0.112051, 0.0703151, 0.0285793);
  check_value(", sheen: 0.8, sheen_tint: 0.5", 0.111705, 0.0705312, 0.0293573);
  check_value(", flatness: 0.7", 0.109531, 0.0691606, 0.0287902);
  check_value(", clearcoat: 0.9, clearcoat_gloss: 0.2", 0.112143, 0.0709871, 0.0298307);
  check_value(
      ", metallic: 0.3, spec_tint: 0.4, sheen: 0.5, sheen_tint: 1, flatness: 0.2, clearcoat: 0.5, "
      "clearcoat_gloss: 0.5, spec_trans: 0.25",
      0.0695738, 0.0438727, 0.0181717);
}

TEST_CASE("principled: clear and white it is rough glass, from both sides") {
  const Ref<Bsdf> clear =
      principled("base_color: 1, spec_trans: 1, roughness: 0.6, ior: 1.4, masking: separable");
  const Ref<Bsdf> glass =
      test::build("{ type: rough_dielectric, alpha: 0.36, ior: 1.4, masking: separable }");
  CHECK(clear->events() == glass->events());
  CHECK(clear->relative_ior() == glass->relative_ior());
  for (const Transport transport : {Transport::radiance, Transport::importance}) {
    for (const EventMask events : {EventMask::all, EventMask::reflect, EventMask::transmit}) {
      for (const Vec3 wo : {kOut, -kOut}) {
        for (const Vec3 wi : {kIn, -kIn, test::direction(150, 200), test::direction(30, 200)}) {
          const ScatterValue a = clear->evaluate({}, wo, wi, {transport, events});
          const ScatterValue b = glass->evaluate({}, wo, wi, {transport, events});
          CHECK(a.value.g == doctest::Approx(b.value.g).epsilon(1e-4));
          CHECK(a.pdf == doctest::Approx(b.pdf).epsilon(1e-4));
        }
      }
    }
  }
}

TEST_CASE("principled: opaque it is black from behind") {
  const Ref<Bsdf> opaque = principled("sheen: 1, clearcoat: 1, metallic: 0.5");
  CHECK(opaque->events() == mask_of(Event::smooth_reflect));
  CHECK(opaque->relative_ior() == 1);
  CHECK(opaque->evaluate({}, -kOut, -kIn, {}).pdf == 0);
  CHECK(opaque->evaluate({}, kOut, -kIn, {}).pdf == 0);
  CHECK_FALSE(opaque->sample({}, -kOut, 0.5f, {0.3f, 0.6f}, {}));
}

TEST_CASE("principled: half clear, the color's root goes through and the rest is matt") {
  const std::string rest = "roughness: 0.5, spec_trans: ";
  const Vec3 below = test::direction(150, 200);
  const Rgb through = value(principled("base_color: [1, 0.25, 0], " + rest + "0.4"), kOut, below);
  const Rgb whole = value(principled("base_color: 1, " + rest + "1"), kOut, below);
  CHECK(whole.r > 0);
  CHECK(through.r == doctest::Approx(0.4 * whole.r));
  CHECK(through.g == doctest::Approx(0.2 * whole.r));
  CHECK(through.b == 0);
}

TEST_CASE("principled: the index by either parameter") {
  CHECK(value(principled("specular: 0.5")) == value(principled("ior: 1.5")));
  CHECK(value(principled("metallic: 0")) == value(principled("ior: 1.5")));
  const float one = 2 / (1 - std::sqrt(0.08f)) - 1;
  CHECK(value(principled("specular: 1")).g ==
        doctest::Approx(value(principled("ior: " + std::to_string(one))).g));
}

TEST_CASE("principled: how smooth it gets") {
  CHECK(principled("roughness: 0.6")->roughness({}) == doctest::Approx(0.36));
  CHECK(principled("roughness: 0")->roughness({}) == doctest::Approx(0.001));
  CHECK(principled("roughness: 0, spec_trans: 1, ior: 1.003")->roughness({}) ==
        doctest::Approx(0.01).epsilon(1e-3));
  CHECK(principled("clearcoat: 1, clearcoat_gloss: 0.5")->roughness({}) == doctest::Approx(0.0505));
}

TEST_CASE("principled: what it gains, and where it gains nothing") {
  const Vec3 above{0, 0, 1}, grazing = test::direction(89, 30);
  const auto albedo = [](const std::string& settings, Vec3 wo) {
    return test::smooth_albedo(*principled(settings), wo);
  };
  CHECK(albedo("base_color: 1", above) == doctest::Approx(1.043).epsilon(0.002));
  CHECK(albedo("base_color: 1", grazing) == doctest::Approx(1.224).epsilon(0.002));
  CHECK(albedo("base_color: 1, roughness: 1", grazing) == doctest::Approx(1.605).epsilon(0.005));
  for (const char* conserving :
       {"base_color: 0.6, roughness: 1", "base_color: 0.6, roughness: 0.3",
        "base_color: 1, metallic: 1", "base_color: 1, metallic: 1, roughness: 1"}) {
    CAPTURE(conserving);
    for (const double theta : {0.0, 45.0, 75.0, 89.0}) {
      CHECK(albedo(conserving, test::direction(theta, 30)) < 1.001);
    }
  }
}

}  // namespace pharos
