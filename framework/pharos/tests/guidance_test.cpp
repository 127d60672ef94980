// How one number chooses between unguided sampling and the guides, among them, and within a guide.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/sampling/sampler.h>

namespace pharos {
namespace {

/// A sampler whose numbers are all the same.
class SameNumbers final : public PreparedSampler {
 public:
  std::uint64_t begin(const PathKey&) const override { return 0; }
  float value_1d(const SampleStream&, Dimension) const override { return kNumber; }
  Vec2 value_2d(const SampleStream&, Dimension) const override { return {kNumber, kNumber}; }
  static constexpr float kNumber = 0.25f;
};

/// Proposes a direction that holds guide_choice of the branches 0 and 1, and the guide's number.
class TellsChoices final : public GuidingDistribution {
 public:
  explicit TellsChoices(float number = 0) : number_(number) {}
  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return propose_direction(
        {stream.get_1d(Purpose::guide_choice), stream.get_1d(Purpose::guide_choice, 1), number_});
  }
  float density(const ResolvedVertex&) const override { return 1; }

 private:
  float number_;
};

TEST_CASE("guidance: one number chooses between techniques, among methods and within a guide") {
  const SameNumbers numbers;
  const SampleStream path(numbers, {});
  const VertexStream stream(path, 1);
  const std::array guides{TellsChoices(0), TellsChoices(1), TellsChoices(2)};
  const std::array<float, 3> shares{0.5f, 0.375f, 0.125f};
  std::vector<GuidePart> parts;
  for (std::uint32_t i = 0; i < 3; ++i) {
    parts.push_back({.distribution = &guides[i], .share = shares[i], .method = i});
  }
  const Guidance guidance{.parts = parts, .unguided_share = 0.25f, .methods = 3};
  constexpr int kNumbers = 1 << 12;
  int unguided = 0;
  // The proposals in the order in which they come.
  std::vector<Vec3> told;
  for (int i = 0; i < kNumbers; ++i) {
    const float u = static_cast<float>(i) / kNumbers;
    if (!guidance.guides(u)) {
      ++unguided;
      continue;
    }
    const auto proposal = guidance.propose(stream, guidance.rest_of(u));
    REQUIRE(proposal);
    told.push_back(proposal->direction);
  }
  CHECK(unguided == kNumbers / 4);
  // Each method has its share of the numbers, and they run from 0 to 1.
  std::size_t first = 0;
  for (std::size_t method = 0; method < 3; ++method) {
    const auto count = static_cast<std::size_t>(shares[method] * kNumbers * 3 / 4);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 choice = told[first + i];
      const float expected = static_cast<float>(i) / static_cast<float>(count);
      CHECK(choice.x == doctest::Approx(expected).epsilon(1e-5));
      CHECK(choice.y == SameNumbers::kNumber);
      CHECK(choice.z == static_cast<float>(method));
    }
    first += count;
  }
  CHECK(first == told.size());
}

TEST_CASE("guidance: the largest number leaves a number below one") {
  const SameNumbers numbers;
  const SampleStream path(numbers, {});
  const TellsChoices guide;
  const GuidePart part{.distribution = &guide, .share = 1};
  for (const float share : {0.0f, 0.1f, 0.3f, 0.9f, 0.95f}) {
    const Guidance guidance{.parts = {&part, 1}, .unguided_share = share, .methods = 1};
    const float u = kOneMinusEpsilon;
    REQUIRE(guidance.guides(u));
    const auto proposal = guidance.propose(VertexStream(path, 1), guidance.rest_of(u));
    CHECK(proposal->direction.x < 1);
    CHECK(proposal->direction.x > 0.99f);
  }
  const TellsChoices rare(1);
  const std::array parts{GuidePart{.distribution = &guide, .share = 1 - 1e-6f},
                         GuidePart{.distribution = &rare, .share = 1e-6f}};
  const Guidance guidance{.parts = parts, .unguided_share = 0.3f, .methods = 2};
  const auto proposal = guidance.propose(VertexStream(path, 1), 1);
  CHECK(proposal->direction.z == 1);
  CHECK(proposal->direction.x < 1);
}

TEST_CASE("streams: the number of an earlier choice replaces guide_choice alone") {
  const SameNumbers numbers;
  const SampleStream path(numbers, {});
  const VertexStream stream = VertexStream(path, 1).candidate(3).after_choice(0.75f);
  CHECK(stream.get_1d(Purpose::guide_choice) == 0.75f);
  CHECK(stream.get_1d(Purpose::guide_choice, 1) == SameNumbers::kNumber);
  CHECK(stream.get_1d(Purpose::guide_distance) == SameNumbers::kNumber);
  CHECK(stream.get_1d(Purpose::bsdf_choice) == SameNumbers::kNumber);
  CHECK(VertexStream(path, 1).get_1d(Purpose::guide_choice) == SameNumbers::kNumber);
}

TEST_CASE("streams: the numbers of copies are evenly spread together") {
  const SameNumbers numbers;
  const SampleStream path(numbers, {});
  const VertexStream stream(path, 1);
  CHECK(stream.copy(0).get_1d(Purpose::bsdf_choice) == SameNumbers::kNumber);
  CHECK(stream.copy(0).get_2d(Purpose::bsdf_direction) == stream.get_2d(Purpose::bsdf_direction));
  for (const std::uint32_t count : {2u, 5u, 13u, 100u}) {
    std::vector<float> places;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float u = stream.copy(i).get_1d(Purpose::bsdf_choice);
      CHECK((u >= 0 && u < 1));
      places.push_back(u);
    }
    std::sort(places.begin(), places.end());
    float widest = 1 + places.front() - places.back();
    for (std::uint32_t i = 1; i < count; ++i) {
      widest = std::max(widest, places[i] - places[i - 1]);
    }
    CHECK(widest < 1.7f / static_cast<float>(count));
  }
  std::array<int, 16> cells{};
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Vec2 u = stream.copy(i).get_2d(Purpose::bsdf_direction);
    CHECK((u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
    ++cells[static_cast<std::size_t>(4 * u.y) * 4 + static_cast<std::size_t>(4 * u.x)];
  }
  for (const int points : cells) CHECK(std::abs(points - 4) <= 2);
}

TEST_CASE("guidance: without guides nothing decides for them") {
  CHECK_FALSE(Guidance{}.guides(0));
  CHECK_FALSE(Guidance{}.guides(kOneMinusEpsilon));
}

}  // namespace
}  // namespace pharos
