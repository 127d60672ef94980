// Tests of the queries to mixing policies and guides. Policies are asked first, with the knowledge
// of every model about the vertex. Learned mixing follows a guide that refines its regions.

#include <sstream>

#include "made_up.h"

namespace pharos::testing {
namespace {

/// The queries in their order.
using Calls = std::vector<std::string>;

/// A model of three regions that returns the same place for every vertex.
class FixedModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "fixed";
  explicit FixedModel(Place place) : place_(place) {}
  ModelInfo info() const override { return {.name = std::string(kName), .regions = 3}; }
  void archive(Archive&) override {}
  Place place(const GuidingVertex&) const override { return place_; }
  double density(Point3, const Vec3*) const override { return 1; }

 private:
  Place place_;
};

/// The distribution that guides return. These tests do not sample it.
class EvenDistribution final : public GuidingDistribution {
 public:
  std::optional<Proposal> propose(const VertexStream&) const override { return std::nullopt; }
  float density(const ResolvedVertex&) const override { return 0.25f; }
};

/// A guider that logs the region of each query. It may know nothing.
class SpyGuider final : public GuiderOf<FixedModel> {
 public:
  SpyGuider(std::string name, Calls& calls, bool knows_something = true)
      : name_(std::move(name)), calls_(calls), knows_something_(knows_something) {}
  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const FixedModel&, const GuidingQuery& query,
                                   Arena& arena) const override {
    calls_.push_back(fmt::format("{} in region {}", name_, query.region));
    return knows_something_ ? arena.make<EvenDistribution>() : nullptr;
  }

 private:
  std::string name_;
  Calls& calls_;
  bool knows_something_;
};

/// A policy that logs its queries and returns fixed shares.
class SpyShares final : public MixingShares {
 public:
  SpyShares(std::vector<float> shares, Calls& calls) : shares_(std::move(shares)), calls_(calls) {}
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const GuidingVertex& v = query.vertex.current;
    std::string call =
        fmt::format("mixing at ({:g}, {:g}, {:g}), roughness {:g}, bounce {}:", v.position.x,
                    v.position.y, v.position.z, v.roughness, query.vertex.bounce);
    for (const Place& p : query.places) call += fmt::format(" {}/{:g}", p.region, p.evidence);
    calls_.push_back(call);
    REQUIRE(shares.size() == shares_.size());
    std::copy(shares_.begin(), shares_.end(), shares.begin());
    return 42;
  }

 private:
  std::vector<float> shares_;
  Calls& calls_;
};

/// Returns a method whose regions are numbered from `first_region` on.
GuidingFrame::Method method(const SpyGuider& guider, Place place, std::uint32_t first_region) {
  return {.guider = BoundGuider(guider, std::make_shared<const FixedModel>(place)),
          .traits = guider.traits(),
          .first_region = first_region};
}

/// Returns the guidance at an ordinary vertex that is the vertex number `bounce` of its path.
Guidance asked(const GuidingFrame& frame, Arena& arena, std::uint16_t bounce = 3) {
  static const Wall wall;
  GuidingQuery query = wall.query({0.25f, 0.5f, 2}, bounce);
  query.current.roughness = 0.125f;
  return frame.query(query, arena);
}

TEST_CASE("a policy is asked before the guides, with what all models know of the vertex") {
  Calls calls;
  const SpyGuider a("a", calls), b("b", calls), c("c", calls);
  const GuidingFrame frame(
      {method(a, {.region = 1, .evidence = 5}, 0),
       method(b, {.region = 2, .evidence = 7}, 3),
       method(c, {.region = 0, .evidence = 0}, 6),
       {.first_region = 9}},
      std::make_shared<const SpyShares>(std::vector{0.25f, 0.5f, 0.25f, 0.0f, 0.0f}, calls));
  Arena arena;
  const Guidance guidance = asked(frame, arena);
  // The policy sees regions that are numbered through all models. A guide sees the number within
  // its model.
  CHECK(calls == Calls{"mixing at (0.25, 0.5, 2), roughness 0.125, bounce 3: 1/5 5/7 6/0 9/0",
                       "a in region 1", "b in region 2"});
  CHECK(guidance.mixing_key == 42);
  CHECK(guidance.unguided_share == 0.25f);
  CHECK(guidance.methods == 4);
  REQUIRE(guidance.parts.size() == 2);
  CHECK(guidance.parts[0].share == doctest::Approx(2.0 / 3));
  CHECK(guidance.parts[1].share == doctest::Approx(1.0 / 3));
}

TEST_CASE("a method with the share 0 is not asked") {
  Calls calls;
  const SpyGuider a("a", calls), b("b", calls);
  const GuidingFrame frame(
      {method(a, {}, 0), method(b, {}, 3)},
      std::make_shared<const SpyShares>(std::vector{0.25f, 0.0f, 0.75f}, calls));
  Arena arena;
  const Guidance guidance = asked(frame, arena);
  REQUIRE(calls.size() == 2);
  CHECK(calls[1] == "b in region 0");
  REQUIRE(guidance.parts.size() == 1);
  CHECK(guidance.parts[0].method == 1);
  CHECK(guidance.parts[0].share == 1);
  CHECK(guidance.unguided_share == 0.25f);
}

TEST_CASE("if a method turns out to know nothing, the others divide its share") {
  Calls calls;
  const SpyGuider a("a", calls, false), b("b", calls), c("c", calls);
  const GuidingFrame frame(
      {method(a, {}, 0), method(b, {}, 3), method(c, {}, 6)},
      std::make_shared<const SpyShares>(std::vector{0.25f, 0.25f, 0.125f, 0.375f}, calls));
  Arena arena;
  const Guidance guidance = asked(frame, arena);
  CHECK(calls.size() == 4);
  CHECK(guidance.unguided_share == 0.25f);
  REQUIRE(guidance.parts.size() == 2);
  CHECK(guidance.parts[0].method == 1);
  CHECK(guidance.parts[0].share == doctest::Approx(0.25));
  CHECK(guidance.parts[1].share == doctest::Approx(0.75));
}

TEST_CASE("if no guide knows anything, the vertex is unguided, whatever the policy said") {
  Calls calls;
  const SpyGuider a("a", calls, false);
  const auto shares = std::make_shared<const SpyShares>(std::vector{0.25f, 0.75f}, calls);
  Arena arena;
  const Guidance declined = asked(GuidingFrame({method(a, {}, 0)}, shares), arena);
  CHECK(calls.size() == 2);
  // If no model knows anything, the policy is not asked either.
  const Guidance unknown = asked(GuidingFrame({method(a, {.evidence = 0}, 0)}, shares), arena);
  CHECK(calls.size() == 2);
  for (const Guidance& guidance : {declined, unknown}) {
    CHECK_FALSE(guidance.is_guided());
    CHECK(guidance.unguided_share == 1);
    CHECK(guidance.mixing_key == kNoMixing);
  }
}

TEST_CASE("vertices after the last bounce are unguided, and no plugin is asked there") {
  Calls calls;
  const SpyGuider a("a", calls);
  const GuidingFrame frame({method(a, {}, 0)},
                           std::make_shared<const SpyShares>(std::vector{0.25f, 0.75f}, calls),
                           {.last_bounce = 2});
  Arena arena;
  const Guidance after = asked(frame, arena, 3);
  CHECK_FALSE(after.is_guided());
  CHECK(after.unguided_share == 1);
  CHECK(calls.empty());
  CHECK(asked(frame, arena, 2).is_guided());
  // Paths from both ends have no numbers: a step has one density, whichever end it was made from.
  CHECK(asked(frame, arena, 0).is_guided());
}

TEST_CASE("two methods share one model: one learner is trained, and both guiders take part") {
  const MadeUpLearning learning(
      "{ methods: [ { learner: uniform, guider: uniform }, { guider: uniform, weight: 3 } ] }");
  const auto methods = learning.settings().resolved_methods();
  REQUIRE(methods.size() == 2);
  CHECK_FALSE(methods[0].shares_model());
  CHECK(methods[1].shares_model());
  CHECK_FALSE(methods[1].learns());

  GuidingState state = learning.begin();
  state.absorb(lit_path());
  state.update({0, 1});
  REQUIRE(state.model(0) != nullptr);
  CHECK(state.model(1) == state.model(0));
  CHECK(state.model_bytes() == state.model(0)->info().bytes);
  const auto learned = state.learned();
  REQUIRE(learned->models.size() == 1);
  CHECK(learned->models[0].learner == "uniform");
  REQUIRE(learned->methods.size() == 2);
  CHECK(learned->methods[1].model == 0);
  CHECK(learned->methods[1].weight == 3);

  const Wall wall;
  GuidingQuery query = wall.query({0, 0, 0});
  Arena arena;
  const Guidance guidance = state.frame()->query(query, arena);
  REQUIRE(guidance.parts.size() == 2);
  CHECK(guidance.parts[0].share == doctest::Approx(0.25));
  CHECK(guidance.parts[1].share == doctest::Approx(0.75));
  CHECK(guidance.unguided_share == doctest::Approx(0.5));
}

constexpr const char* kRefined =
    "{ learner: { type: stub_direction, refine: true }, guider: stub_direction, "
    "mixing: stub_learned }";

/// Returns the share of unguided samples at a point.
float unguided_share(const GuidingState& state, float x) {
  const Wall wall;
  GuidingQuery query = wall.query({x, 0, 0});
  Arena arena;
  const Guidance guidance = state.frame()->query(query, arena);
  REQUIRE(guidance.is_guided());
  return guidance.unguided_share;
}

TEST_CASE("a learner tells where refined regions came from") {
  const MadeUpLearning learning(kRefined);
  const auto state = learning.settings().learner->begin(learning.context());
  state->absorb(lit_path());
  CHECK(state->update({0, 1}).region_origins.empty());
  for (std::uint32_t iteration = 1, regions = 2; regions <= 8; ++iteration, regions *= 2) {
    const Learned learned = state->update({iteration, 1});
    CHECK(learned.model->info().regions == regions);
    REQUIRE(learned.region_origins.size() == regions);
    CHECK(learned.region_origins.back() == regions / 2 - 1);
  }
}

TEST_CASE("regions double and keep what was learned for them") {
  const MadeUpLearning learning(kRefined);
  GuidingState state = learning.begin();
  CHECK(state.frame() == nullptr);
  state.absorb(lit_path());
  state.update({0, 1});
  CHECK(state.model(0)->info().regions == 1);
  for (std::uint32_t iteration = 1, regions = 2; regions <= 8; ++iteration, regions *= 2) {
    state.update({iteration, 1});
    CHECK(state.model(0)->info().regions == regions);
  }
  // The share of the single region rose to its maximum. All refined regions inherit it.
  for (const float x : {-0.9f, -0.1f, 0.3f, 0.9f}) {
    CHECK(unguided_share(state, x) == doctest::Approx(0.9f));
  }
}

TEST_CASE("what was learned can be saved, and goes on from there") {
  const MadeUpLearning learning(kRefined);
  const auto saved = [](const GuidingState& state) {
    std::ostringstream out;
    save(out, state);
    return out.str();
  };
  GuidingState state = learning.begin(), other = learning.begin();
  state.absorb(lit_path());
  for (std::uint32_t iteration = 0; iteration < 2; ++iteration) state.update({iteration, 1});
  state.absorb(lit_path());
  CHECK(saved(other) != saved(state));
  std::istringstream in(saved(state));
  load(in, other);
  CHECK(saved(other) == saved(state));
  CHECK(unguided_share(other, 0.3f) == doctest::Approx(0.9f));
  for (GuidingState* each : {&state, &other}) each->update({2, 1});
  CHECK(other.model(0)->info().regions == 4);
  CHECK(saved(other) == saved(state));
}

}  // namespace
}  // namespace pharos::testing
