#include <doctest/doctest.h>

#include <pharos/statistics/quadrature.h>

#include "../box.h"
#include "../gaussian.h"

namespace pharos {
namespace {

/// The integral over the filter's square and a border beyond it.
double integrate(const Filter& filter) {
  const double r = filter.radius();
  const auto weight = [&](double x, double y) {
    return double{filter.evaluate({static_cast<float>(x), static_cast<float>(y)})};
  };
  // Cells that end where the filter does, so that its edge is no obstacle.
  const double cuts[] = {-1.5 * r, -r, 0, r, 1.5 * r};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
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

}  // namespace pharos
