#include "../fixed.h"

#include <array>

#include <doctest/doctest.h>

#include <pharos/conformance/stage.h>

namespace pharos {
namespace {

/// Returns the shares of unguided sampling and of two methods, whose models have the evidence
/// `first` and `second`.
std::array<float, 3> shares_of(const MixingState& state, float first, float second,
                               std::uint32_t region = 0) {
  const GuidingQuery vertex{};
  const std::array places{Place{.region = region, .evidence = first},
                          Place{.region = region + 1, .evidence = second}};
  std::array<float, 3> shares{};
  state.shares()->at({vertex, places}, shares);
  return shares;
}

}  // namespace

TEST_CASE("fixed mixing: the same share in every region and iteration") {
  const std::array weights{1.0f, 3.0f};
  const auto state = FixedMixing({.unguided_fraction = 0.25f}).begin(weights);
  for (const std::uint32_t regions : {0u, 1u, 100u}) {
    state->update(regions, {}, false);
    for (const std::uint32_t region : {0u, 98u}) {
      CHECK(shares_of(*state, 1, 1, region)[0] == 0.25f);
    }
  }
}

TEST_CASE("fixed mixing: one half by default") {
  const std::array weights{1.0f, 1.0f};
  CHECK(shares_of(*FixedMixing(FixedMixing::Settings{}).begin(weights), 1, 1)[0] == 0.5f);
}

TEST_CASE("fixed mixing: the lens has a share of its own, if one is given") {
  const std::array weights{1.0f, 1.0f};
  const std::array places{Place{.evidence = 1}, Place{.evidence = 1}};
  const Ref<Bsdf> bsdf = conformance::black_bsdf();
  const SurfacePoint point;
  const LocalScattering scattering(point, *bsdf, {0, 0, 1}, Transport::radiance);
  const auto unguided = [&](const FixedMixing::Settings& settings, const LocalScattering* at) {
    const GuidingQuery vertex{.scattering = at};
    std::array<float, 3> shares{};
    FixedMixing(settings).begin(weights)->shares()->at({vertex, places}, shares);
    return shares[0];
  };
  CHECK(unguided({.unguided_fraction = 0.25f}, nullptr) == 0.25f);
  CHECK(unguided({.unguided_fraction = 0.25f}, &scattering) == 0.25f);
  CHECK(unguided({.unguided_fraction = 0.25f, .unguided_camera = 0.75f}, nullptr) == 0.75f);
  CHECK(unguided({.unguided_fraction = 0.25f, .unguided_camera = 0.75f}, &scattering) == 0.25f);
}

TEST_CASE("fixed mixing: methods that know something share the rest by their weights") {
  const std::array weights{1.0f, 3.0f};
  const auto state = FixedMixing({.unguided_fraction = 0.25f}).begin(weights);
  const auto check = [&](float first, float second, const std::array<float, 3>& expected) {
    const std::array<float, 3> shares = shares_of(*state, first, second);
    for (std::size_t i = 0; i < 3; ++i) CHECK(shares[i] == doctest::Approx(expected[i]));
  };
  check(1, 1, {0.25f, 0.1875f, 0.5625f});
  check(100, 1, {0.25f, 0.1875f, 0.5625f});
  check(1, 0, {0.25f, 0.75f, 0});
  check(0, 1, {0.25f, 0, 0.75f});
  check(0, 0, {1, 0, 0});
}

}  // namespace pharos
