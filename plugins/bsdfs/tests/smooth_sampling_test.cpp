#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/hypothesis.h>

#include "../diffuse.h"
#include "../rough_conductor.h"
#include "../rough_diffuse.h"
#include "bsdf_checks.h"

namespace pharos {
namespace {

struct Subject {
  std::string name;
  std::shared_ptr<const Bsdf> bsdf;
};

/// Diffuse, rough_diffuse and rough_conductor, with parameters spread over their range.
std::vector<Subject> subjects() {
  const Ref<Texture> gray = test::uniform(Rgb(0.7f));
  std::vector<Subject> all;
  for (const HemisphereWarp warp : {HemisphereWarp::concentric, HemisphereWarp::octahedral}) {
    all.push_back(
        {"diffuse, " + Value<HemisphereWarp>::default_text(warp),
         std::make_shared<Diffuse>(Diffuse::Settings{.reflectance = gray, .warp = warp})});
  }
  all.push_back({"rough_diffuse, octahedral",
                 std::make_shared<RoughDiffuse>(RoughDiffuse::Settings{
                     .reflectance = gray, .alpha = gray, .warp = HemisphereWarp::octahedral})});
  for (const Masking masking : {Masking::height_correlated, Masking::separable}) {
    for (const float alpha : {0.002f, 0.05f, 0.3f, 1.0f}) {
      const RoughConductor::Settings settings{
          .alpha = alpha, .masking = masking, .specular_reflectance = gray};
      all.push_back(
          {"rough_conductor " + std::to_string(alpha), std::make_shared<RoughConductor>(settings)});
    }
  }
  return all;
}

const std::vector<Vec3> kOutgoing{test::direction(0, 0), test::direction(40, 200),
                                  test::direction(75, 100), test::direction(88, -30)};

}  // namespace

TEST_CASE("smooth BSDFs: samples follow their density") {
  std::vector<double> p_values;
  std::uint64_t seed = 0;
  for (const Subject& subject : subjects()) {
    for (const Vec3 wo : kOutgoing) {
      for (const EventMask mask : {EventMask::all, EventMask::reflect}) {
        if (mask != EventMask::all && wo.z < 0.9f) continue;
        const auto fit = test::fit_smooth(*subject.bsdf, wo, {.events = mask}, ++seed);
        INFO(subject.name << " at cosine " << wo.z << ": integral " << fit.integral);
        CHECK(fit.is_density());
        CHECK(fit.missed == doctest::Approx(1 - fit.integral).epsilon(0.02).scale(1));
        p_values.push_back(fit.chi_square.p_value);
      }
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("smooth BSDFs: weight is value over pdf") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const Vec3 wo : kOutgoing) test::check_samples(*subject.bsdf, wo, {});
  }
}

TEST_CASE("smooth BSDFs: grazing and degenerate directions give finite values") {
  const SurfacePoint point;
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    for (const float z : {1e-3f, 1e-6f, 1e-12f, 1e-30f, 1e-42f}) {
      const Vec3 wo{-0.6f, 0.8f, z};
      test::check_samples(*subject.bsdf, wo, {});
      for (const Vec3 wi : {Vec3{0, 0, 1}, Vec3{0.6f, -0.8f, z}, Vec3{0.6f, -0.8f, 1e-5f}, wo}) {
        const ScatterValue v = subject.bsdf->evaluate(point, wo, wi, {});
        CHECK(is_finite(v.value));
        CHECK(std::isfinite(v.pdf));
        CHECK(v.pdf >= 0);
      }
    }
  }
}

TEST_CASE("smooth BSDFs: reciprocity") {
  const SurfacePoint point;
  const Vec3 a = test::direction(20, 10), b = test::direction(70, 160);
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const Rgb there = subject.bsdf->evaluate(point, a, b, {}).value / b.z;
    const Rgb back = subject.bsdf->evaluate(point, b, a, {}).value / a.z;
    for (int c = 0; c < 3; ++c) CHECK(there[c] == doctest::Approx(back[c]).epsilon(1e-4));
  }
}

TEST_CASE("smooth BSDFs: the back side and excluded events are black") {
  const SurfacePoint point;
  const Vec3 above = test::direction(30, 0), below = test::direction(150, 0);
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const Bsdf& bsdf = *subject.bsdf;
    CHECK(bsdf.evaluate(point, above, below, {}).pdf == 0);
    CHECK(bsdf.evaluate(point, below, above, {}).pdf == 0);
    CHECK(bsdf.evaluate(point, below, below, {}).pdf == 0);
    CHECK_FALSE(bsdf.sample(point, below, 0.5f, {0.3f, 0.4f}, {}));
    for (const EventMask mask : {EventMask::nothing, EventMask::discrete, EventMask::transmit}) {
      CHECK(bsdf.evaluate(point, above, above, {.events = mask}).pdf == 0);
      CHECK(is_black(bsdf.evaluate(point, above, above, {.events = mask}).value));
      CHECK_FALSE(bsdf.sample(point, above, 0.5f, {0.3f, 0.4f}, {.events = mask}));
    }
    CHECK(bsdf.discrete(point, above, {}).count == 0);
  }
}

}  // namespace pharos
