#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/quadrature.h>
#include <pharos/statistics/von_mises_fisher.h>

namespace pharos::von_mises_fisher {
namespace {

double density_about(Vec3 mean, double kappa, Vec3 w) {
  return mode_density(kappa) * std::exp(-kappa * double{length_squared(w - mean)} / 2);
}

TEST_CASE(
    "von Mises-Fisher: the density at the mean makes the integral one, the mean cosine is its "
    "mean") {
  for (const double kappa : {1e-9, 1e-4, 0.9e-3, 1.1e-3, 0.1, 1.0, 5.0, 100.0, 3e4}) {
    CAPTURE(kappa);
    // Integrates over 1 - cos theta, in steps relative to the width of the lobe.
    double integral = 0, cosine = 0, at = 0;
    const double end = std::min(2.0, 60 / kappa);
    constexpr int kSteps = 200'000;
    for (int i = 0; i < kSteps; ++i) {
      const double step = end / kSteps;
      at = (i + 0.5) * step;
      const double share = kTwoPi * mode_density(kappa) * std::exp(-kappa * at) * step;
      integral += share;
      cosine += share * (1 - at);
    }
    CHECK(integral == doctest::Approx(1).epsilon(1e-7));
    CHECK(mean_cosine(kappa) == doctest::Approx(cosine).epsilon(1e-6).scale(1e-7));
    CHECK(log_norm(kappa) == doctest::Approx(std::log(mode_density(kappa)) - kappa));
  }
}

TEST_CASE("von Mises-Fisher: the concentration is the inverse of the mean cosine") {
  for (double kappa = 1e-3; kappa < 1e5; kappa *= 1.7) {
    CHECK(concentration(mean_cosine(kappa)) == doctest::Approx(kappa).epsilon(1e-6).scale(0));
  }
  CHECK(concentration(0) == 0);
}

TEST_CASE(
    "von Mises-Fisher: draws follow their density, from almost uniform to very narrow lobes") {
  std::uint64_t seed = 1;
  RandomStream random(2);
  for (const double kappa : {1e-5, 0.01, 1.0, 30.0, 1000.0, 32768.0}) {
    CAPTURE(kappa);
    const Vec3 mean = warp::sphere_from_square(random.next_2d());
    const auto draw = [&](RandomStream& stream) -> std::optional<Vec3> {
      return sample(mean, static_cast<float>(kappa), stream.next_2d());
    };
    const auto fit = statistics::fit_direction_density(
        draw, [&](Vec3 w) { return density_about(mean, kappa, w); },
        {.draws = 100'000, .seed = seed++, .cells = 100, .quadrature_tolerance = 1e-3});
    CHECK(fit.chi_square.p_value > 1e-4);
    CHECK(fit.is_density(2e-3));
  }
}

TEST_CASE("von Mises-Fisher: extreme numbers make unit directions") {
  const float one = std::nextafter(1.0f, 0.0f);
  for (const float kappa : {0.0f, 1e-5f, 1.0f, 1e6f}) {
    for (const Vec2 u : {Vec2{0, 0}, {one, 0.3f}, {0.5f, one}}) {
      CHECK(length(sample({0, 0, -1}, kappa, u)) == doctest::Approx(1).epsilon(1e-5));
    }
  }
}

}  // namespace
}  // namespace pharos::von_mises_fisher
