#include "../fixed.h"

#include <doctest/doctest.h>

namespace pharos {

TEST_CASE("fixed mixing: the same fraction in every region and iteration") {
  const FixedMixing policy({.unguided_fraction = 0.25f});
  const auto state = policy.begin();
  for (const std::uint32_t regions : {0u, 1u, 100u}) {
    const auto fractions = state->update(regions, {});
    for (const std::uint32_t region : {0u, 99u}) {
      CHECK(fractions->unguided_fraction(region) == 0.25f);
    }
  }
}

TEST_CASE("fixed mixing: one half by default") {
  const auto state = FixedMixing(FixedMixing::Settings{}).begin();
  CHECK(state->update(1, {})->unguided_fraction(0) == 0.5f);
}

}  // namespace pharos
