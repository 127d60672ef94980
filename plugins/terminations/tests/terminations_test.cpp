#include <doctest/doctest.h>

#include "../none.h"
#include "../throughput.h"

namespace pharos {
namespace {

/// A path of throughput `throughput` at a vertex.
TerminationQuery at_wall(float throughput, std::uint16_t bounce = 6) {
  return {.bounce = bounce, .throughput = Rgb(throughput)};
}

}  // namespace

TEST_CASE("none: there is no rule") {
  CHECK(NoTermination().begin({})->rule() == nullptr);
  CHECK_FALSE(NoTermination().learns());
}

TEST_CASE("throughput: survival as the throughput says, from the first vertex of roulette on") {
  const auto rule = ThroughputTermination({.depth = 3, .limit = 0.9f}).begin({})->rule();
  CHECK(rule->stage() == TerminationRule::Stage::step);
  CHECK(rule->factor(at_wall(0.25f, 2)) == 1);
  CHECK(rule->factor(at_wall(0.25f, 3)) == 0.25f);
  CHECK(rule->factor(at_wall(2, 3)) == 0.9f);
  TerminationQuery refracted = at_wall(0.25f);
  refracted.first_throughput = 0.5f;
  refracted.solid_angle_scale = 1.5f;
  CHECK(rule->factor(refracted) == doctest::Approx(0.75));
}

}  // namespace pharos
