#include <doctest/doctest.h>

#include "../fixed.h"

namespace pharos {
namespace {

TEST_CASE("a fixed fraction stays, however regions change") {
  const FixedMixing mixing({.unguided_fraction = 0.25f});
  CHECK_FALSE(mixing.learns());
  const auto state = mixing.begin();
  CHECK(state->update(1, {})->unguided_fraction(0) == 0.25f);
  const std::vector<std::uint32_t> origins{0, 0, 0};
  CHECK(state->update(3, origins)->unguided_fraction(2) == 0.25f);
}

}  // namespace
}  // namespace pharos
