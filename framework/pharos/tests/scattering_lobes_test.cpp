#include <cmath>

#include <doctest/doctest.h>

#include <pharos/guiding/toolkit/scattering_lobes.h>
#include <pharos/statistics/von_mises_fisher.h>

namespace pharos {
namespace {

/// A phase function of two lobes, one ahead and one straight up, or of one alone.
class LobePhase final : public PhaseFunction {
 public:
  LobePhase(float kappa, float share_up) : kappa_(kappa), share_up_(share_up) {}
  float evaluate(Vec3, Vec3 wi) const override {
    const auto at = [&](Vec3 mean, float kappa) {
      return static_cast<float>(von_mises_fisher::mode_density(kappa)) *
             std::exp(kappa * (dot(mean, wi) - 1));
    };
    return (1 - share_up_) * at(kAhead, kappa_) + share_up_ * at(kUp, 3);
  }
  Vec3 sample(Vec3, Vec2 u) const override {
    if (u.x < share_up_) return von_mises_fisher::sample(kUp, 3, {u.x / share_up_, u.y});
    return von_mises_fisher::sample(kAhead, kappa_, {(u.x - share_up_) / (1 - share_up_), u.y});
  }
  float mean_cosine() const override { return 0; }

  static constexpr Vec3 kAhead{0, 0, 1}, kUp{0, 1, 0};

 private:
  float kappa_, share_up_;
};

ScatteringLobes fitted(const LobePhase& phase, std::uint32_t samples = 64) {
  const LocalScattering scattering(phase, Rgb(2), {0, 0, -1}, Transport::radiance);
  return fit_scattering(scattering, {.bsdf_samples = samples});
}

TEST_CASE("scattering lobes: lobes are fitted to what a vertex scatters, narrow or wide") {
  for (const float kappa : {0.5f, 5.0f, 60.0f, 2000.0f}) {
    CAPTURE(kappa);
    const ScatteringLobes lobes = fitted(LobePhase(kappa, 0));
    REQUIRE(lobes.count >= 1);
    const ScatteringLobe& first = lobes.lobes[0];
    CHECK(dot(first.mean, LobePhase::kAhead) > 0.9f);
    // The fit has 64 directions only, and their tail may form a lobe of its own.
    CHECK(first.kappa > 0.6f * kappa);
    CHECK(first.kappa < 4 * kappa + 2);
  }
}

TEST_CASE("scattering lobes: a narrow lobe in a wide one makes two, with their shares") {
  const ScatteringLobes lobes = fitted(LobePhase(500, 0.6f));
  REQUIRE(lobes.count == 2);
  CHECK(dot(lobes.lobes[0].mean, LobePhase::kAhead) > 0.99f);
  CHECK(lobes.lobes[0].kappa > 200);
  CHECK(dot(lobes.lobes[1].mean, LobePhase::kUp) > 0.9f);
  const auto weight = [](const ScatteringLobe& f) {
    return f.peak / von_mises_fisher::mode_density(f.kappa);
  };
  CHECK(weight(lobes.lobes[0]) + weight(lobes.lobes[1]) == doctest::Approx(1).epsilon(1e-3));
  CHECK(weight(lobes.lobes[1]) > 0.5);
}

TEST_CASE("scattering lobes: few directions make no needles, and the fit is the same each time") {
  const ScatteringLobes lobes = fitted(LobePhase(1e5f, 0), 4);
  REQUIRE(lobes.count == 1);
  CHECK(lobes.lobes[0].kappa <= 1e4f);
  const LobePhase phase(20, 0.5f);
  CHECK(fitted(phase).lobes[0].kappa == fitted(phase).lobes[0].kappa);
}

}  // namespace
}  // namespace pharos
