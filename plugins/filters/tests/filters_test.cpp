#include <numbers>

#include <doctest/doctest.h>

#include <pharos/statistics/quadrature.h>

#include "../box.h"
#include "../catmull_rom.h"
#include "../gaussian.h"
#include "../lanczos.h"
#include "../mitchell.h"
#include "../tent.h"

namespace pharos {
namespace {

/// The integral over the filter's square and a border beyond it.
double integrate(const Filter& filter) {
  const double r = filter.radius();
  const auto weight = [&](double x, double y) {
    return double{filter.evaluate({static_cast<float>(x), static_cast<float>(y)})};
  };
  // Cells end where the filter or one of its pieces ends, so that edges cause no error.
  const double cuts[] = {-1.5 * r, -r, -0.5 * r, 0, 0.5 * r, r, 1.5 * r};
  double sum = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      sum += statistics::integrate(weight, {cuts[i], cuts[i + 1], cuts[j], cuts[j + 1]}).value;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("box filter") {
  for (const float radius : {0.5f, 1.0f, 2.25f}) {
    const BoxFilter filter({.radius = radius});
    CHECK(filter.radius() == radius);
    CHECK(filter.integral() == doctest::Approx(integrate(filter)));
    CHECK(filter.evaluate({0.9f * radius, -0.9f * radius}) == 1);
    CHECK(filter.evaluate({1.1f * radius, 0}) == 0);
    CHECK(filter.evaluate({0, -1.1f * radius}) == 0);
  }
}

TEST_CASE("gaussian filter") {
  for (const float stddev : {0.3f, 0.5f, 2.0f}) {
    const GaussianFilter filter({.stddev = stddev, .radius = 1.5f});
    CAPTURE(stddev);
    CHECK(filter.integral() == doctest::Approx(integrate(filter)).epsilon(1e-4));
    CHECK(filter.evaluate({1.5f, 0}) == doctest::Approx(0).scale(1e-3));
    CHECK(filter.evaluate({0, -1.6f}) == 0);
    CHECK(filter.evaluate({2, 2}) == 0);
    CHECK(filter.evaluate({0.2f, 0.7f}) == filter.evaluate({-0.7f, 0.2f}));
    CHECK(filter.evaluate({0, 0}) > filter.evaluate({0.1f, 0}));
  }
}

TEST_CASE("gaussian filter: known values") {
  const GaussianFilter filter({.stddev = 0.5f, .radius = 1.5f});
  const double floor = std::exp(-4.5);
  CHECK(filter.evaluate({0.5f, 0}) ==
        doctest::Approx((std::exp(-0.5) - floor) * (1 - floor)).epsilon(1e-5));
}

TEST_CASE("tent filter") {
  for (const float radius : {0.5f, 1.0f, 2.25f}) {
    const TentFilter filter({.radius = radius});
    CAPTURE(radius);
    CHECK(filter.integral() == doctest::Approx(integrate(filter)));
    CHECK(filter.evaluate({0, 0}) == 1);
    CHECK(filter.evaluate({-0.25f * radius, 0.5f * radius}) == doctest::Approx(0.375));
    CHECK(filter.evaluate({radius, 0}) == 0);
    CHECK(filter.evaluate({1.1f * radius, -1.1f * radius}) == 0);
  }
}

/// The sum of the weights that the pixels around a film position give to it.
double sum_of_weights(const Filter& filter, Vec2 film) {
  double sum = 0;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      sum += filter.evaluate({film.x - static_cast<float>(x), film.y - static_cast<float>(y)});
    }
  }
  return sum;
}

TEST_CASE("tent and mitchell: pixels share every sample, one in all") {
  for (const Vec2 film : {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{0.13f, -0.41f}}) {
    CHECK(sum_of_weights(TentFilter({}), film) == doctest::Approx(1));
    CHECK(sum_of_weights(MitchellFilter({}), film) == doctest::Approx(1));
    CHECK(sum_of_weights(MitchellFilter({.b = 0.2f, .c = 0.9f}), film) == doctest::Approx(1));
  }
}

TEST_CASE("mitchell filter: integral and support") {
  for (const Vec2 bc : {Vec2{1.0f / 3, 1.0f / 3}, Vec2{1, 0}, Vec2{0, 0.5f}, Vec2{1, 1}}) {
    for (const float radius : {0.5f, 2.0f, 3.0f}) {
      const MitchellFilter filter({.b = bc.x, .c = bc.y, .radius = radius});
      CAPTURE(bc.x);
      CAPTURE(radius);
      CHECK(filter.integral() == doctest::Approx(integrate(filter)).epsilon(1e-5));
      CHECK(filter.evaluate({radius, 0}) == 0);
      CHECK(filter.evaluate({0, -1.01f * radius}) == 0);
    }
  }
}

TEST_CASE("mitchell filter: known members of the family") {
  const MitchellFilter catmull_rom({.b = 0, .c = 0.5f});
  CHECK(catmull_rom.evaluate({0, 0}) == 1);
  CHECK(catmull_rom.evaluate({1, 0}) == doctest::Approx(0).scale(1));
  CHECK(catmull_rom.evaluate({1.5f, 0}) == doctest::Approx(-1.0 / 16));
  CHECK(catmull_rom.evaluate({1.5f, 1.5f}) == doctest::Approx(1.0 / 256));
  const MitchellFilter b_spline({.b = 1, .c = 0});
  CHECK(b_spline.evaluate({0, 0}) == doctest::Approx(4.0 / 9));
  CHECK(b_spline.evaluate({-1, 0}) == doctest::Approx(1.0 / 9));
  CHECK(b_spline.evaluate({1.5f, 0}) == doctest::Approx(2.0 / 3 / 48));
  const MitchellFilter own({});
  CHECK(own.evaluate({0, 0}) == doctest::Approx(64.0 / 81));
  CHECK(own.evaluate({1, 0}) == doctest::Approx(8.0 / 9 / 18));
  CHECK(own.evaluate({0, 1.4f}) < 0);
}

TEST_CASE("catmull_rom filter: interpolates, sums to one and reproduces parabolas") {
  const CatmullRomFilter filter({});
  CHECK(filter.radius() == 2);
  CHECK(filter.integral() == doctest::Approx(integrate(filter)).epsilon(1e-5));
  CHECK(filter.evaluate({0, 0}) == 1);
  CHECK(filter.evaluate({0, 1}) == doctest::Approx(0).scale(1));
  CHECK(filter.evaluate({-1.5f, 0}) == doctest::Approx(-1.0 / 16));
  for (const float x : {0.0f, 0.2f, 0.5f, 0.9f}) {
    double parabola = 0;
    for (int i = -2; i <= 3; ++i) {
      parabola += i * i * double{filter.evaluate({x - static_cast<float>(i), 0})};
    }
    CHECK(parabola == doctest::Approx(x * x).epsilon(1e-5));
    CHECK(sum_of_weights(filter, {x, 0.3f}) == doctest::Approx(1));
  }
}

TEST_CASE("lanczos filter: known values, integral and support") {
  for (const int lobes : {1, 2, 3, 5}) {
    const LanczosFilter filter({.lobes = lobes});
    CAPTURE(lobes);
    CHECK(filter.radius() == static_cast<float>(lobes));
    CHECK(filter.integral() == doctest::Approx(integrate(filter)).epsilon(1e-5));
    CHECK(filter.evaluate({0, 0}) == 1);
    CHECK(filter.evaluate({1e-30f, 0}) == 1);
    for (int i = 1; i <= lobes; ++i) {
      CHECK(filter.evaluate({static_cast<float>(i), 0}) == doctest::Approx(0).scale(1));
    }
    CHECK(filter.evaluate({0, -1.01f * static_cast<float>(lobes)}) == 0);
  }
  // sin(pi / 2) sin(pi / 6) / ((pi / 2) (pi / 6)), and the trough of the second lobe.
  const LanczosFilter filter({});
  const double pi = std::numbers::pi;
  CHECK(filter.evaluate({0.5f, 0}) == doctest::Approx(6 / (pi * pi)));
  CHECK(filter.evaluate({0, 1.5f}) == doctest::Approx(-4 / (3 * pi * pi)));
}

}  // namespace pharos
