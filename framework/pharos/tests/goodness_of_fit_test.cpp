#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/frame.h>
#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>
#include <pharos/statistics/quadrature.h>

namespace pharos::statistics {
namespace {

/// A von Mises-Fisher lobe about `frame.n`, in a form that is stable for sharp lobes.
struct Lobe {
  Frame frame;
  double sharpness;

  std::optional<Vec3> sample(RandomStream& random) const {
    const Vec2 u = random.next_2d();
    const double rest = std::exp(-2 * sharpness);
    const double t = -std::log(rest + (1 - rest) * (1 - double{u.x})) / sharpness;
    return frame.to_world(direction_at(t, 2 * M_PI * u.y));
  }
  double density(Vec3 d) const {
    const Vec3 apart = d - frame.n;
    const double t = 0.5 * length_squared(apart);
    return sharpness / (2 * M_PI * (1 - std::exp(-2 * sharpness))) * std::exp(-sharpness * t);
  }
  DensityFit fit(double scale, std::uint64_t seed) const {
    return fit_direction_density([&](RandomStream& random) { return sample(random); },
                                 [&](Vec3 d) { return scale * density(d); }, {.seed = seed});
  }
};

}  // namespace

TEST_CASE("chi-square: textbook value") {
  // A die is thrown 60 times: the sum of (o - 10)^2 / 10 is 13.4, with five degrees of freedom.
  const std::vector<double> observed{5, 8, 9, 8, 10, 20}, expected(6, 10);
  const ChiSquareResult result = chi_square_test(observed, expected);
  CHECK(result.statistic == doctest::Approx(13.4));
  CHECK(result.degrees_of_freedom == 5);
  CHECK(result.p_value == doctest::Approx(0.01991).epsilon(1e-3));
}

TEST_CASE("chi-square: small cells are pooled") {
  const std::vector<double> observed{1, 3, 2, 50, 44}, expected{2, 1, 3, 46, 48};
  const ChiSquareResult result = chi_square_test(observed, expected);
  CHECK(result.degrees_of_freedom == 2);
  CHECK(result.statistic == doctest::Approx(0.0 + 16.0 / 46 + 16.0 / 48));
}

TEST_CASE("quadrature: smooth, singular and discontinuous integrands") {
  const auto polynomial = [](double x, double y) { return x * x * x + 3 * y * y; };
  CHECK(integrate(polynomial, {0, 2, 0, 1}).value == doctest::Approx(6).epsilon(1e-12));
  const auto root = [](double x, double y) { return std::sqrt(x) + y; };
  const Integral a = integrate(root, {}, {.tolerance = 1e-7});
  CHECK(std::abs(a.value - 7.0 / 6) <= a.error);
  CHECK(a.error <= 1e-7);
  const auto disk = [](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; };
  std::vector<Rectangle> cells;
  for (int i = 0; i < 64; ++i) {
    cells.push_back({(i % 8) / 8.0, (i % 8 + 1) / 8.0, (i / 8) / 8.0, (i / 8 + 1) / 8.0});
  }
  double sum = 0;
  for (const Integral& cell : integrate_cells(disk, cells, {.tolerance = 1e-4})) sum += cell.value;
  CHECK(std::abs(sum - M_PI / 4) < 1e-3);
}

TEST_CASE("quadrature: solid angle and cosine") {
  CHECK(integrate_sphere([](Vec3) { return 1.0; }).value == doctest::Approx(4 * M_PI));
  const auto cosine = [](Vec3 d) { return std::max(0.0, double{d.z}); };
  CHECK(integrate_sphere(cosine).value == doctest::Approx(M_PI).epsilon(1e-5));
}

TEST_CASE("density fit: lobes of any width pass, about any axis") {
  std::vector<double> p_values;
  std::uint64_t seed = 0;
  for (const double sharpness : {1e-3, 1.0, 100.0, 1e4, 1e6}) {
    for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, normalize(Vec3{1, -0.2f, 0.3f})}) {
      CAPTURE(sharpness);
      CAPTURE(axis.z);
      const DensityFit fit = Lobe{Frame::from_normal(axis), sharpness}.fit(1, ++seed);
      CHECK(fit.is_density());
      CHECK(fit.integral == doctest::Approx(1).epsilon(1e-3));
      CHECK(fit.integral_error < 2e-3);
      CHECK(fit.chi_square.degrees_of_freedom > 100);
      p_values.push_back(fit.chi_square.p_value);
    }
  }
  for (const double p : holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("density fit: faults are seen") {
  const Lobe lobe{Frame::from_normal(normalize(Vec3{0.3f, 0.2f, 1})), 50};
  CHECK_FALSE(lobe.fit(1.03, 1).is_density());
  CHECK(lobe.fit(0.97, 2).chi_square.p_value < 1e-6);

  const auto draw = [&](RandomStream& random) { return lobe.sample(random); };
  const Lobe wider{lobe.frame, 47};
  CHECK(fit_direction_density(draw, [&](Vec3 d) { return wider.density(d); }).chi_square.p_value <
        1e-6);

  const auto half = [&](Vec3 d) { return d.x > 0 ? 2 * lobe.density(d) : 0.0; };
  CHECK(fit_direction_density(draw, half).outside_support > 1000);
}

TEST_CASE("density fit: scattered supports with sharp edges are integrated whole") {
  // Draws are uniform over the area of the square [-1,1]^2 at height h below the origin. Near the
  // horizon, the directions form four spikes about the corners, at azimuths from 0 to 2 pi.
  std::vector<double> p_values;
  for (const double height : {0.5, 0.1, 0.03}) {
    const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
      const Vec2 u = random.next_2d();
      return normalize(Vec3{2 * u.x - 1, 2 * u.y - 1, -static_cast<float>(height)});
    };
    const auto density = [&](Vec3 d) -> double {
      if (d.z >= 0) return 0;
      const double t = height / -double{d.z};
      const bool inside = std::abs(t * d.x) < 1 && std::abs(t * d.y) < 1;
      return inside ? t * t / (4 * -double{d.z}) : 0;
    };
    const DensityFit fit = fit_direction_density(draw, density);
    CAPTURE(height);
    CHECK(fit.integral == doctest::Approx(1).epsilon(5e-4));
    CHECK(fit.integral_error < 1e-3);
    p_values.push_back(fit.chi_square.p_value);
  }
  for (const double p : holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("density fit: draws without a result are part of the test") {
  const Lobe lobe{Frame{}, 3};
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    const auto d = lobe.sample(random);
    return d->z > 0 ? d : std::nullopt;
  };
  const auto clipped = [&](Vec3 d) { return d.z > 0 ? lobe.density(d) : 0.0; };
  const DensityFit fit = fit_direction_density(draw, clipped);
  CHECK(fit.is_density());
  CHECK(fit.missed == doctest::Approx(1 - fit.integral).epsilon(0.05));
  CHECK(fit.chi_square.p_value > 0.01);
  // A density that claims that nothing is lost must fail.
  const double kept = fit.integral;
  const auto renormalized = [&](Vec3 d) { return clipped(d) / kept; };
  CHECK(fit_direction_density(draw, renormalized).chi_square.p_value < 1e-6);
}

TEST_CASE("density fit: unit square") {
  const auto draw = [](RandomStream& random) -> std::optional<Vec2> {
    const Vec2 u = random.next_2d();
    return Vec2{std::sqrt(u.x), u.y};
  };
  const DensityFit fit = fit_square_density(draw, [](Vec2 p) { return 2.0 * p.x; });
  CHECK(fit.is_density());
  CHECK(fit.chi_square.p_value > 0.01);
  CHECK(fit_square_density(draw, [](Vec2) { return 1.0; }).chi_square.p_value < 1e-6);
}

}  // namespace pharos::statistics
