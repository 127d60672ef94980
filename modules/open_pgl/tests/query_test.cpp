#include "../query.h"

#include <cmath>

#include <doctest/doctest.h>

#include "../model.h"
#include "test_paths.h"

namespace pharos::open_pgl {
namespace {

using namespace testing;

const Query kPlain{.position = {0.5f, -0.4f, 0}};
const Query kCosine{.position = {0.5f, -0.4f, 0}, .cosine_about = {1, 0, 0}};
const Query kElsewhere{.position = {-0.7f, 0.6f, 0}};
const Query kOutside{.position = {50, 0, 0}};
const Query kVolume{.position = {0.5f, -0.4f, 0}, .in_volume = true};

std::shared_ptr<const OpenPglModel> model(const OpenPglSettings& settings = {}) {
  return std::dynamic_pointer_cast<const OpenPglModel>(trained(settings));
}

/// Returns the answer of a copy of the model that was asked nothing before.
float fresh_pdf(const OpenPglModel& model, const Query& query, Vec3 w) {
  const auto copy = std::dynamic_pointer_cast<const OpenPglModel>(loaded(saved(model)));
  const Workplace* answer = copy->at(query);
  REQUIRE(answer != nullptr);
  return answer->pdf(w);
}

TEST_CASE("an answer does not depend on what was asked before it") {
  const auto learned = model();
  const Vec3 w = normalize(Vec3{0.3f, -0.2f, 1});
  for (const Query& query : {kPlain, kCosine, kElsewhere, kPlain, kPlain, kElsewhere, kCosine}) {
    const Workplace* answer = learned->at(query);
    REQUIRE(answer != nullptr);
    CHECK(answer->pdf(w) == fresh_pdf(*learned, query, w));
    CHECK(learned->at(kOutside) == nullptr);
  }
  CHECK(fresh_pdf(*learned, kPlain, w) != fresh_pdf(*learned, kCosine, w));
}

TEST_CASE("surfaces tell nothing about volumes") {
  CHECK(model()->at(kVolume) == nullptr);
}

TEST_CASE("densities integrate to one over the sphere, with and without the cosine") {
  for (const Directions directions :
       {Directions::parallax_vmm, Directions::vmm, Directions::quadtree}) {
    const auto learned = model({.directions = directions});
    for (const Query& query : {kPlain, kCosine, kElsewhere}) {
      const Workplace* answer = learned->at(query);
      REQUIRE(answer != nullptr);
      constexpr int kSide = 512;
      double sum = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2 u{(i % kSide + 0.5f) / kSide, (i / kSide + 0.5f) / kSide};
        sum += answer->pdf(warp::sphere_from_square(u)) / warp::sphere_pdf();
      }
      CHECK(sum / (kSide * kSide) == doctest::Approx(1).epsilon(0.005));
    }
  }
}

TEST_CASE("directions are drawn with the density: the same mean direction") {
  const auto learned = model();
  const Workplace* answer = learned->at(kPlain);
  REQUIRE(answer != nullptr);
  constexpr int kDraws = 100'000;
  RandomStream random(3);
  Vec3 drawn, expected;
  for (int i = 0; i < kDraws; ++i) {
    drawn = drawn + answer->sample(random.next_2d());
    const Vec3 w = warp::sphere_from_square(random.next_2d());
    expected = expected + (answer->pdf(w) / warp::sphere_pdf()) * w;
  }
  CHECK(length(drawn - expected) / kDraws < 0.02);
  CHECK(length(drawn) / kDraws > 0.1);
}

}  // namespace
}  // namespace pharos::open_pgl
