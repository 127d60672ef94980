#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/statistics/adam.h>

namespace pharos::statistics {

TEST_CASE("adam: the first step has the length of the learning rate, whatever the gradient") {
  for (const double gradient : {1e-4, 1.0, 1e6}) {
    CHECK(Adam().step(gradient, {.learning_rate = 0.3}) == doctest::Approx(-0.3).epsilon(1e-3));
    CHECK(Adam().step(-gradient, {.learning_rate = 0.3}) == doctest::Approx(0.3).epsilon(1e-3));
  }
  // A gradient as large as epsilon causes half a step.
  CHECK(Adam().step(1e-8, {.learning_rate = 0.3}) == doctest::Approx(-0.15));
}

TEST_CASE("adam: the second step in closed form") {
  const double b1 = 0.8, b2 = 0.99, g1 = 2, g2 = -0.5, epsilon = 0.25;
  const AdamRates rates{
      .learning_rate = 0.1, .mean_decay = b1, .square_decay = b2, .epsilon = epsilon};
  Adam adam;
  adam.step(g1, rates);
  const double mean = (b1 * g1 + g2) / (1 + b1);
  const double square = (b2 * g1 * g1 + g2 * g2) / (1 + b2);
  CHECK(adam.step(g2, rates) == doctest::Approx(-0.1 * mean / (std::sqrt(square) + epsilon)));
}

TEST_CASE("adam: no gradient, no step") {
  Adam adam;
  for (int i = 0; i < 10; ++i) CHECK(adam.step(0, {}) == 0);
}

TEST_CASE("adam: finds the minimum of a quadratic of any scale") {
  for (const double scale : {1e-3, 1.0, 1e5}) {
    double x = 0;
    Adam adam;
    for (int i = 0; i < 4000; ++i) x += adam.step(2 * scale * (x - 1.5), {});
    CHECK(x == doctest::Approx(1.5).epsilon(1e-3));
  }
}

TEST_CASE("adam: averages noise out") {
  RandomStream random(1);
  double x = 0, sum = 0;
  Adam adam;
  for (int i = 0; i < 20000; ++i) {
    x += adam.step(2 * (x - 1.5) + 10 * (random.next_1d() - 0.5), {});
    if (i >= 10000) sum += x;
  }
  CHECK(sum / 10000 == doctest::Approx(1.5).epsilon(0.02));
}

TEST_CASE("adam: goes on from where it was saved as if nothing had been") {
  Adam adam, restored;
  for (const double gradient : {1.0, -3.0, 0.5}) adam.step(gradient, {});
  std::stringstream file;
  save(file, adam);
  load(file, restored);
  for (const double gradient : {2.0, -1.0}) {
    CHECK(restored.step(gradient, {}) == adam.step(gradient, {}));
  }
}

}  // namespace pharos::statistics
