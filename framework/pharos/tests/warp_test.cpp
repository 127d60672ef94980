#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/goodness_of_fit.h>

using namespace pharos;
using namespace pharos::warp;

namespace {

/// A fit with a smaller p-value is refused. The seeds are fixed, and eight fits are tested.
constexpr double kSignificance = 1e-3;
/// The number of draws. It is large enough to distinguish u from u^1.03 in one coordinate of a
/// warp, as a test below verifies.
constexpr std::size_t kDraws = 400'000;

/// Visits random points of the square and points on its corners and edges.
template <class Visit>
void for_square_points(Visit&& visit) {
  RandomStream random(7);
  for (int i = 0; i < 2000; ++i) visit(random.next_2d());
  for (const float x : {0.0f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon}) {
    for (const float y : {0.0f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon}) visit(Vec2{x, y});
  }
}

bool near(Vec2 a, Vec2 b, float tolerance) {
  return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance;
}
bool is_primary(Vec2 u) {
  return u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1;
}

template <class Warp, class Pdf>
void check_directions(Warp&& warp, Pdf&& pdf) {
  const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
    return warp(random.next_2d());
  };
  const auto fit = statistics::fit_direction_density(draw, pdf, {.draws = kDraws, .seed = 3});
  CHECK(fit.is_density());
  CHECK(fit.integral == doctest::Approx(1).epsilon(2e-3));
  CHECK(fit.chi_square.p_value > kSignificance);
}

}  // namespace

TEST_CASE("disk: inverse, range, and area is kept") {
  int inner = 0, right = 0, count = 0;
  for_square_points([&](Vec2 u) {
    const Vec2 p = disk_from_square(u);
    const float radius = std::sqrt(p.x * p.x + p.y * p.y);
    CHECK(radius <= 1 + 1e-6f);
    const Vec2 back = square_from_disk(p);
    CHECK(is_primary(back));
    CHECK(near(back, u, 1e-6f));
    inner += radius * radius < 0.25f;
    right += p.x > 0;
    ++count;
  });
  const double sigma = std::sqrt(count * 0.25 * 0.75);
  CHECK(std::abs(inner - 0.25 * count) < 4 * sigma);
  CHECK(std::abs(right - 0.5 * count) < 4 * sigma);
  const auto fit = statistics::fit_square_density(
      [](RandomStream& random) -> std::optional<Vec2> {
        const Vec2 p = disk_from_square(random.next_2d());
        return Vec2{0.5f * (p.x + 1) * kOneMinusEpsilon, 0.5f * (p.y + 1) * kOneMinusEpsilon};
      },
      [](Vec2 v) {
        const float x = 2 * v.x - 1, y = 2 * v.y - 1;
        return x * x + y * y <= 1 + 1e-5f ? 4.0 * disk_pdf() : 0.0;
      },
      {.draws = kDraws, .seed = 3});
  CHECK(fit.chi_square.p_value > kSignificance);
}

TEST_CASE("cosine hemisphere: unit length, inverse, density") {
  for_square_points([](Vec2 u) {
    const Vec3 d = cosine_hemisphere_from_square(u);
    CHECK(d.z >= 0);
    CHECK(length(d) == doctest::Approx(1).epsilon(1e-6));
    CHECK(near(square_from_cosine_hemisphere(d), u, 1e-6f));
  });
  check_directions(cosine_hemisphere_from_square,
                   [](Vec3 d) -> double { return cosine_hemisphere_pdf(d.z); });
  CHECK(cosine_hemisphere_pdf(-0.5f) == 0);
}

TEST_CASE("cosine hemisphere: grazing directions keep their digits") {
  const float next_to_edge = 0x1p-23f;  // radius 1 - 2^-22
  for (const float around : {0.1f, 0.2f, 0.3f, 0.37f, 0.6f}) {
    const Vec3 d = cosine_hemisphere_from_square({next_to_edge, around});
    CHECK(d.z == doctest::Approx(std::sqrt(0x1p-21 - 0x1p-44)).epsilon(1e-5));
  }
}

TEST_CASE("octahedral hemisphere: unit length, inverse, density") {
  for_square_points([](Vec2 u) {
    const Vec3 d = octahedral_hemisphere_from_square(u);
    CHECK(d.z >= 0);
    CHECK(length(d) == doctest::Approx(1).epsilon(1e-6));
    CHECK(near(square_from_octahedral_hemisphere(d), u, 1e-6f));
  });
  check_directions(octahedral_hemisphere_from_square,
                   [](Vec3 d) -> double { return octahedral_hemisphere_pdf(d); });
  CHECK(octahedral_hemisphere_pdf({0.6f, 0, -0.8f}) == 0);
}

TEST_CASE("octahedral hemisphere: straight lines become great circles") {
  // The line lies within one face. The concentric map bends the same line.
  const auto bend = [](auto&& warp) {
    const Vec3 from = warp(Vec2{0.6f, 0.55f}), to = warp(Vec2{0.95f, 0.8f});
    return std::abs(dot(normalize(cross(from, to)), warp(Vec2{0.775f, 0.675f})));
  };
  CHECK(bend(octahedral_hemisphere_from_square) < 1e-6f);
  CHECK(bend(cosine_hemisphere_from_square) > 1e-3f);
}

TEST_CASE("the fits have the power that is claimed for them") {
  const auto skewed = [](RandomStream& random) -> std::optional<Vec3> {
    const Vec2 u = random.next_2d();
    return sphere_from_square({std::pow(u.x, 1.03f), u.y});
  };
  const auto uniform = [](Vec3) -> double { return sphere_pdf(); };
  const auto fit = statistics::fit_direction_density(skewed, uniform, {.draws = kDraws, .seed = 3});
  CHECK(fit.chi_square.p_value < 1e-2 * kSignificance);
}

TEST_CASE("sphere: unit length, inverse, density") {
  for_square_points([](Vec2 u) {
    const Vec3 d = sphere_from_square(u);
    CHECK(length(d) == doctest::Approx(1).epsilon(1e-6));
    const Vec2 back = square_from_sphere(d);
    CHECK(is_primary(back));
    const bool at_pole = u.x < 1e-6f || u.x > 1 - 1e-6f;
    CHECK(std::abs(back.x - u.x) < 1e-6f);
    if (!at_pole) CHECK(near(back, u, 1e-5f));
  });
  check_directions(sphere_from_square, [](Vec3) -> double { return sphere_pdf(); });
}

TEST_CASE("cones of any width: density and extent") {
  for (const float one_minus_cos : {1.5f, 0.3f, 1e-3f}) {
    CAPTURE(one_minus_cos);
    check_directions(
        [=](Vec2 u) { return cone_from_square(u, one_minus_cos); },
        [=](Vec3 d) -> double {
          return 1 - d.z <= one_minus_cos * (1 + 1e-4f) + 1e-7f ? cone_pdf(one_minus_cos) : 0.0f;
        });
  }
}

TEST_CASE("tiny cones: the angle is uniform in area though the cosine rounds to one") {
  const float one_minus_cos = 5e-13f;  // half-angle 1e-6
  double sum = 0, sum_squared = 0;
  constexpr int kCount = 20'000;
  RandomStream random(5);
  for (int i = 0; i < kCount; ++i) {
    const Vec3 d = cone_from_square(random.next_2d(), one_minus_cos);
    const double area = (double(d.x) * d.x + double(d.y) * d.y) / (2 * one_minus_cos);
    CHECK(area <= 1 + 1e-5);
    sum += area;
    sum_squared += area * area;
  }
  CHECK(sum / kCount == doctest::Approx(0.5).epsilon(0.02));
  CHECK(sum_squared / kCount == doctest::Approx(1.0 / 3).epsilon(0.03));
}

TEST_CASE("triangle: inside, and uniform") {
  double sum[5] = {};
  int count = 0;
  RandomStream random(11);
  for (; count < 100'000; ++count) {
    const Vec2 b = triangle_from_square(random.next_2d());
    REQUIRE(b.x >= 0);
    REQUIRE(b.y >= 0);
    REQUIRE(b.x + b.y <= 1 + 1e-7f);
    const double moments[5] = {b.x, b.y, b.x * b.x, b.y * b.y, b.x * b.y};
    for (int i = 0; i < 5; ++i) sum[i] += moments[i];
  }
  // The moments over a triangle are E[b] = 1/3, E[b^2] = 1/6, and 1/12 for the product.
  const double expected[5] = {1.0 / 3, 1.0 / 3, 1.0 / 6, 1.0 / 6, 1.0 / 12};
  for (int i = 0; i < 5; ++i) CHECK(sum[i] / count == doctest::Approx(expected[i]).epsilon(0.01));
}

TEST_CASE("triangle: density over the square that holds it") {
  const auto fit = statistics::fit_square_density(
      [](RandomStream& random) -> std::optional<Vec2> {
        const Vec2 b = triangle_from_square(random.next_2d());
        return Vec2{std::min(b.x, kOneMinusEpsilon), std::min(b.y, kOneMinusEpsilon)};
      },
      [](Vec2 b) { return b.x + b.y <= 1 + 1e-6f ? 2.0 : 0.0; }, {.draws = kDraws, .seed = 4});
  CHECK(fit.chi_square.p_value > kSignificance);
}

TEST_CASE("normal quantile in single precision: that of the middle of each cell") {
  double worst = 0;
  for (std::uint32_t i = 0; i < 1u << 24; i += i < 4096 || i > (1u << 24) - 4096 ? 1 : 997) {
    const double expected = normal_from_unit((i + 0.5) * 0x1p-24);
    const double error = fast_normal_from_unit(static_cast<float>(i) * 0x1p-24f) - expected;
    worst = std::max(worst, std::abs(error) / std::max(std::abs(expected), 1.0));
  }
  CHECK(worst < 3e-6);
  CHECK(std::abs(fast_normal_from_unit(0)) < 5.5);
}

TEST_CASE("normal quantile: tabulated values, tails, inverse of the distribution function") {
  CHECK(normal_from_unit(0.5) == 0);
  CHECK(normal_from_unit(0.975) == doctest::Approx(1.959963984540054).epsilon(1e-14));
  CHECK(normal_from_unit(1e-10) == doctest::Approx(-6.361340902404056).epsilon(1e-13));
  const boost::math::normal normal;
  for (const double u : {1e-300, 1e-20, 1e-5, 0.01, 0.3, 0.7, 0.999, 1 - 1e-12}) {
    CHECK(cdf(normal, normal_from_unit(u)) == doctest::Approx(u).epsilon(1e-12));
  }
  CHECK(std::isfinite(normal_from_unit(0)));
  CHECK(std::isfinite(normal_from_unit(1)));
  CHECK(normal_from_unit(0) < -37);
  CHECK(normal_from_unit(1) > 8);
}
