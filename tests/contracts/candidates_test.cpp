// Steps that are chosen among several candidates: where this happens, and what it requires. The
// conformance suite of guiders and the furnaces of tests/faults test the estimates.

#include <cmath>

#include "made_up.h"

namespace pharos::testing {
namespace {

constexpr const char* kFourCandidates =
    "{ learner: stub_direction, guider: stub_direction, candidates: 4, mixing: { type: fixed, "
    "unguided_fraction: 0.25 } }";

/// Returns the guidance at the middle of a wall.
Guidance guidance_in(const GuidingState& state, GuidingQuery& query, Arena& arena) {
  REQUIRE(state.frame() != nullptr);
  return state.frame()->query(query, arena);
}

}  // namespace

TEST_CASE("only steps of the final image are chosen among candidates") {
  const MadeUpLearning learning(kFourCandidates);
  GuidingState state = learning.begin();
  const Wall wall;
  GuidingQuery query = wall.query({0, 0, 0});
  Arena arena;
  for (const std::uint32_t left : {1u, 0u}) {
    state.absorb(lit_path());
    state.update({1 - left, left});
    CHECK(guidance_in(state, query, arena).candidates == (left == 0 ? 4 : 1));
  }
}

TEST_CASE("the expected radiance keeps a constant part of the size of the unguided share") {
  const MadeUpLearning learning(kFourCandidates);
  GuidingState state = learning.begin();
  state.absorb(lit_path());
  state.update({0, 0});
  const Wall wall;
  GuidingQuery query = wall.query({0, 0, 0});
  Arena arena;
  const Guidance guidance = guidance_in(state, query, arena);
  // All light was seen in one of 32 bins. One tenth of the histogram is uniform.
  CHECK(guidance.relative_radiance({0, 0, 1}) == doctest::Approx(0.25 + 0.75 * (0.1 + 0.9 * 32)));
  CHECK(guidance.relative_radiance({0, 0, -1}) == doctest::Approx(0.25 + 0.75 * 0.1));
}

TEST_CASE("where no model knows the radiance, steps are drawn as without candidates") {
  const MadeUpLearning learning(
      "{ candidates: 4, methods: [ { learner: uniform, guider: uniform }, { learner: "
      "stub_segments, guider: stub_segments } ] }");
  GuidingState state = learning.begin();
  state.update({0, 0});  // no path has found light
  const Wall wall;
  GuidingQuery query = wall.query({0, 0, 0});
  Arena arena;
  CHECK(guidance_in(state, query, arena).candidates == 1);
}

TEST_CASE("what candidates require") {
  const auto with = [](const std::string& guiding) {
    return path_config(kDiffuseScene, 4, "{ candidates: 2, " + guiding + " }", 8);
  };
  CHECK_THROWS_WITH_AS(
      config_from(with("learner: stub_vertices, guider: stub_vertices")),
      doctest::Contains("'candidates' above 1 needs guiders that leave distances to media, but "
                        "'stub_vertices' steers them"),
      InputError);
  CHECK_THROWS_WITH_AS(
      config_from(with("learner: stub_segments, guider: stub_segments")),
      doctest::Contains("'candidates' above 1 needs a model that knows the radiance around a "
                        "vertex, but no method has one"),
      InputError);
  std::string both_ends = with("learner: uniform, guider: uniform");
  both_ends.replace(both_ends.find("type: path"), 10, "type: bidirectional");
  CHECK_THROWS_WITH_AS(config_from(both_ends),
                       doctest::Contains("cannot choose steps among several 'candidates'"),
                       InputError);
}

}  // namespace pharos::testing
