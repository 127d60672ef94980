// Tests of the memory of guides along a path. Every copy of the path has its own memory.

#include "made_up.h"

namespace pharos::testing {
namespace {

/// Trained guides, and everything that their paths need.
struct Trained {
  explicit Trained(const std::string& guiding) : learning(guiding), state(learning.begin()) {
    state.absorb(lit_path());
    state.update({0, 0});
  }
  const GuidingFrame& frame() const { return *state.frame(); }

  MadeUpLearning learning;
  GuidingState state;
  Wall wall;
};

constexpr const char* kOneMethod = "{ learner: uniform, guider: stub_memory }";

/// A path that queries the guides at one vertex after another. A copy continues as a path of its
/// own.
struct Path {
  const Trained& guides;
  Arena& arena;  ///< memory that lives as long as the path
  PathMemories memories{};
  std::uint16_t bounce = 0;

  /// Goes to the next vertex. Returns the number of vertices that the guide remembers there.
  float next() {
    ++bounce;
    GuidingQuery query = guides.wall.query({0.1f * static_cast<float>(bounce), 0, 0}, bounce);
    Arena own;  // lives only at this vertex
    const Guidance guidance = guides.frame().query(query, own, &memories, &arena);
    REQUIRE(guidance.is_guided());
    CHECK(query.memory == nullptr);
    return remembered(guidance);
  }

  /// Returns the number n of remembered vertices. The density on the axis of the guide's lobe is (n
  /// + 1) / (2 pi).
  static float remembered(const Guidance& guidance) {
    return 2 * kPi * guidance.density({.direction = {0, 0, 1}}) - 1;
  }
};

TEST_CASE("a guide finds at each vertex what it left at the one before") {
  const Trained guides(kOneMethod);
  Arena arena;
  Path path{guides, arena};
  CHECK(path.next() == doctest::Approx(0));
  CHECK(path.next() == doctest::Approx(1));
  CHECK(path.next() == doctest::Approx(2));
  Path other{guides, arena};
  CHECK(other.next() == doctest::Approx(0));
}

TEST_CASE("a copy of a path goes on with a memory of its own") {
  const Trained guides(kOneMethod);
  Arena arena;
  Path path{guides, arena};
  path.next();
  path.next();
  Path copy = path;
  CHECK(path.next() == doctest::Approx(2));
  CHECK(path.next() == doctest::Approx(3));
  CHECK(copy.next() == doctest::Approx(2));
  CHECK(path.next() == doctest::Approx(4));
  CHECK(copy.next() == doctest::Approx(3));
}

TEST_CASE("methods do not share a memory, even if they share a model") {
  const Trained guides(
      "{ methods: [ { learner: uniform, guider: stub_memory }, { guider: stub_memory } ] }");
  Arena arena;
  Path path{guides, arena};
  for (int n = 0; n < 3; ++n) CHECK(path.next() == doctest::Approx(n));
  CHECK(path.memories[0] != nullptr);
  CHECK(path.memories[1] != nullptr);
  CHECK(path.memories[0] != path.memories[1]);
  CHECK(path.memories[2] == nullptr);
}

TEST_CASE("without memories guides are asked without memory") {
  const Trained guides(kOneMethod);
  Arena arena;
  for (int i = 0; i < 3; ++i) {
    GuidingQuery query = guides.wall.query({0, 0, 0});
    CHECK(Path::remembered(guides.frame().query(query, arena)) == doctest::Approx(0));
    CHECK(query.memory == nullptr);
  }
}

}  // namespace
}  // namespace pharos::testing
