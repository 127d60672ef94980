#include "../finds.h"

#include <doctest/doctest.h>

#include <pharos/core/random.h>

namespace pharos {

TEST_CASE("finds: the slope of a histogram is that of the steps in it") {
  constexpr double kDrawnWith = 0.4;
  constexpr int kSteps = 2000;
  for (const auto which : {MixingObjective::kl, MixingObjective::variance}) {
    for (const double a : {0.05, 0.4, 0.95}) {
      RandomStream random(1);
      Finds finds(32);
      double exact = 0, total = 0;
      for (int i = 0; i < kSteps; ++i) {
        const double u = random.next_1d(), weight = 3 * random.next_1d() * (1 + u);
        finds.add(u, weight);
        const double unguided = u / kDrawnWith, guided = (1 - u) / (1 - kDrawnWith);
        const double q = a * unguided + (1 - a) * guided;
        exact -= weight * (unguided - guided) / (which == MixingObjective::kl ? q : q * q);
        total += weight;
      }
      CHECK(finds.steps() == kSteps);
      CHECK(objective_slope(finds.terms(kDrawnWith), a, which) ==
            doctest::Approx(exact / total).epsilon(0.02));
    }
  }
}

TEST_CASE("finds: the ends of the histogram belong to it, and what found nothing counts") {
  Finds finds(4);
  finds.add(0, 1);
  finds.add(1, 3);
  finds.add(0.5, 0);
  CHECK(finds.steps() == 3);
  const auto terms = finds.terms(0.5);
  REQUIRE(terms.size() == 2);
  CHECK(terms[0].weight == 0.25);
  CHECK(terms[0].guided == 2);
  CHECK(terms[0].excess == -2);
  CHECK(terms[1].weight == 0.75);
  CHECK(terms[1].guided == 0);
  CHECK(terms[1].excess == 2);
}

}  // namespace pharos
