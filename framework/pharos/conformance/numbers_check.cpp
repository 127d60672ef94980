#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pharos/conformance/guided.h>
#include <pharos/conformance/numbers_check.h>

namespace pharos::conformance {
namespace {

/// A sampler of independent numbers that notes which ones were asked for.
class NotingSampler final : public PreparedSampler {
 public:
  std::uint64_t begin(const PathKey& key) const override { return numbers_.begin(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    asked_.push_back(dimension);
    return numbers_.value_1d(stream, dimension);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    asked_.push_back(dimension);
    return numbers_.value_2d(stream, dimension);
  }
  /// Returns what was asked for since the last call.
  std::vector<Dimension> take_asked() const { return std::exchange(asked_, {}); }

 private:
  KeyedSampler numbers_;
  mutable std::vector<Dimension> asked_;
};

/// Returns the name of a purpose that proposals must not ask for; null for the others.
const char* foreign_name(Purpose purpose) {
  switch (purpose) {
    case Purpose::guide_choice:
    case Purpose::guide_direction:
    case Purpose::guide_distance:
    case Purpose::bsdf_choice:
    case Purpose::bsdf_direction:
      return nullptr;
    case Purpose::mix_choice:
      return "mix_choice";
    default:
      return "a number of another part of the path";
  }
}

/// Tests the numbers of one proposal.
void expect_numbers_of_guides(const std::vector<Dimension>& asked, const std::string& where,
                              Check& check) {
  for (const Dimension d : asked) {
    const char* foreign = foreign_name(d.purpose());
    check.expect(foreign == nullptr,
                 [&] { return fmt::format("{}: a proposal asks for {}", where, foreign); });
    const Dimension other(Purpose::bsdf_direction, d.bounce(), d.branch());
    const bool both = d.purpose() == Purpose::guide_direction &&
                      std::find(asked.begin(), asked.end(), other) != asked.end();
    check.expect(!both, [&] {
      return fmt::format("{}: a proposal asks for guide_direction and bsdf_direction of branch {}",
                         where, d.branch());
    });
  }
}

}  // namespace

void check_numbers(const GuidingFrame& frame, const Scene& scene, std::uint64_t seed,
                   Transport transport, Check& check) {
  constexpr std::uint64_t kProposals = 200;
  const NotingSampler numbers;
  for (const auto& vertex : stage_vertices(scene, seed, transport)) {
    Arena arena;
    GuidingQuery query = vertex->query();
    const Guidance guidance = frame.query(query, arena);
    if (!guidance.is_guided()) continue;
    numbers.take_asked();  // forgets what the vertex before has asked for
    for (std::uint64_t path = 0; path < kProposals; ++path) {
      const SampleStream stream(numbers, {.seed = seed, .index = path});
      const float u = (static_cast<float>(path) + 0.5f) / static_cast<float>(kProposals);
      guidance.propose(VertexStream(stream, query.bounce), u);
      expect_numbers_of_guides(numbers.take_asked(), vertex->text(), check);
    }
  }
}

}  // namespace pharos::conformance
