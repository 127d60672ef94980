// Tests of the learning side of a render. A saved and loaded state continues as if learning had
// never stopped.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include <pharos/core/warp.h>
#include <pharos/guiding/pipeline/guiding_state.h>

#include "two_directions.h"

namespace pharos {
namespace {

/// A model with one number for each region.
class TinyModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "tiny";

  TinyModel() = default;
  explicit TinyModel(std::vector<double> numbers) : numbers_(std::move(numbers)) {}
  ModelInfo info() const override {
    return {.name = std::string(kName), .regions = static_cast<std::uint32_t>(numbers_.size())};
  }
  void archive(Archive& archive) override { archive(numbers_); }
  Place place(const GuidingVertex&) const override {
    return {.region = static_cast<std::uint32_t>(numbers_.size()) - 1};
  }
  double density(Point3, const Vec3*) const override { return numbers_.front(); }

 private:
  std::vector<double> numbers_;
};

/// Learns the sum of the light that paths found, halved at each new iteration. Every iteration
/// divides the model's first region.
class TinyState final : public LearningState {
 public:
  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) {
      for (const RecordedVertex& vertex : log[i].vertices) found_ += vertex.emission.r;
    }
  }
  Learned update(const TrainingStage&) override {
    light_ = light_ / 2 + found_;
    found_ = 0;
    const std::uint32_t before = regions_++;
    Learned learned{std::make_shared<TinyModel>(std::vector<double>(regions_, light_))};
    for (std::uint32_t i = 0; i < regions_; ++i) {
      learned.region_origins.push_back(i < before ? i : 0);
    }
    return learned;
  }
  void archive(Archive& archive) override { archive(found_, light_, regions_); }

 private:
  double found_ = 0, light_ = 0;
  std::uint32_t regions_ = 0;
};

class TinyLearner final : public Learner {
 public:
  LearnerTraits traits() const override { return {}; }
  std::unique_ptr<LearningState> begin(const LearningContext&) const override {
    return std::make_unique<TinyState>();
  }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<TinyModel>();
  }
};

/// Samples directions uniformly over the sphere.
class TinyGuider final : public GuiderOf<TinyModel> {
 public:
  GuiderTraits traits() const override { return {.guides_camera = true}; }
  const GuidingDistribution* query(const TinyModel&, const GuidingQuery&,
                                   Arena& arena) const override {
    return arena.make<Sphere>();
  }

 private:
  class Sphere final : public GuidingDistribution {
   public:
    std::optional<Proposal> propose(const VertexStream& stream) const override {
      return Proposal{.direction =
                          warp::sphere_from_square(stream.get_2d(Purpose::guide_direction))};
    }
    float density(const ResolvedVertex&) const override { return warp::sphere_pdf(); }
  };
};

/// A share of unguided samples for each region. The methods divide the rest by their weights.
class TinyShares final : public MixingShares {
 public:
  TinyShares(std::vector<double> paths, std::vector<float> weights, std::size_t silent)
      : paths_(std::move(paths)), weights_(std::move(weights)), silent_(silent) {}
  std::uint32_t at(const MixingQuery& query, std::span<float> shares) const override {
    const std::uint32_t region = query.places.back().region;
    share_by_weight(weights_, query.places, 1 / (2 + static_cast<float>(paths_.at(region))),
                    shares);
    return region;
  }
  bool asks(std::size_t method) const override { return method >= silent_; }

 private:
  std::vector<double> paths_;
  std::vector<float> weights_;
  std::size_t silent_;
};

/// Counts the paths of all iterations, in every region.
class TinyMixingState final : public MixingState {
 public:
  TinyMixingState(std::span<const float> weights, std::size_t silent,
                  std::shared_ptr<std::vector<std::string>> heard)
      : weights_(weights.begin(), weights.end()), silent_(silent), heard_(std::move(heard)) {}
  void absorb(const PathLog& log) override { found_ += static_cast<double>(log.size()); }
  void leave_out(std::size_t method) override {
    if (heard_ != nullptr) heard_->push_back("leave out " + std::to_string(method));
  }
  void update(std::uint32_t regions, std::span<const std::uint32_t> origins, bool) override {
    if (heard_ != nullptr) heard_->push_back("update");
    std::vector<double> next(regions, found_);
    for (std::size_t i = 0; i < regions; ++i) {
      const std::size_t origin = origins.empty() ? i : origins[i];
      if (origin < paths_.size()) next[i] += paths_[origin];
    }
    paths_ = std::move(next);
    found_ = 0;
  }
  std::shared_ptr<const MixingShares> shares() const override {
    return std::make_shared<const TinyShares>(paths_, weights_, silent_);
  }
  void archive(Archive& archive) override { archive(found_, paths_); }

 private:
  double found_ = 0;
  std::vector<double> paths_;
  std::vector<float> weights_;
  std::size_t silent_;
  std::shared_ptr<std::vector<std::string>> heard_;
};

/// A policy that never asks the first `silent` methods. If `heard` is not null, the policy lists
/// the calls of update() and leave_out() there.
class TinyMixing final : public MixingPolicy {
 public:
  explicit TinyMixing(std::size_t silent = 0,
                      std::shared_ptr<std::vector<std::string>> heard = nullptr)
      : silent_(silent), heard_(std::move(heard)) {}
  std::unique_ptr<MixingState> begin(std::span<const float> weights) const override {
    return std::make_unique<TinyMixingState>(weights, silent_, heard_);
  }

 private:
  std::size_t silent_;
  std::shared_ptr<std::vector<std::string>> heard_;
};

/// Returns settings with two learners, where two guiders sample the model of the first learner.
GuidingSettings settings() {
  const auto learner = std::make_shared<const TinyLearner>();
  const auto guider = std::make_shared<const TinyGuider>();
  GuidingSettings settings;
  settings.methods = {{.learner = learner, .guider = guider},
                      {.learner = nullptr, .guider = guider},
                      {.learner = learner, .guider = guider}};
  settings.mixing = std::make_shared<const TinyMixing>();
  return settings;
}

/// Returns a path that finds this much light.
PathLog path_to_light(float light) {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor});
  log.add(RecordedVertex{.parent = 0, .emission = Rgb(light)});
  return log;
}

template <class T>
std::string saved(const T& object) {
  std::ostringstream out;
  save(out, object);
  return out.str();
}

void load_from(const std::string& bytes, GuidingState& state) {
  std::istringstream in(bytes);
  load(in, state);
}

/// Returns the share of unguided samples at the lens.
float unguided_share(const GuidingState& state) {
  Arena arena;
  GuidingQuery query{.current = {.kind = VertexKind::sensor}, .bounce = 0};
  return state.frame()->query(query, arena).unguided_share;
}

/// Absorbs a last path of iteration 1 and all of iteration 2.
void finish(GuidingState& state) {
  state.absorb(path_to_light(3));
  state.update({1, 1});
  state.absorb(path_to_light(5));
  state.update({2, 0});
}

}  // namespace

TEST_CASE("guiding state: saved in the middle of an iteration, it ends with the same models") {
  GuidingState state(settings(), {}), resumed(settings(), {}), forgetful(settings(), {});
  for (GuidingState* s : {&state, &forgetful}) {
    s->absorb(path_to_light(1));
    s->update({0, 1});
  }
  state.absorb(path_to_light(2));
  const std::string file = saved(state);
  load_from(file, resumed);
  CHECK(saved(resumed) == file);
  for (const std::size_t i : {0u, 1u, 2u}) {
    CHECK(saved(*resumed.model(i)) == saved(*state.model(i)));
  }
  CHECK(unguided_share(resumed) == unguided_share(state));

  for (GuidingState* s : {&state, &resumed, &forgetful}) finish(*s);
  for (const std::size_t i : {0u, 1u, 2u}) {
    CHECK(saved(*resumed.model(i)) == saved(*state.model(i)));
    // Paths that were absorbed before saving make a difference.
    CHECK(saved(*forgetful.model(i)) != saved(*state.model(i)));
  }
  CHECK(resumed.model(0)->density({}) == (0.5 * 1 + 2 + 3) * 0.5 + 5);
  CHECK(saved(resumed) == saved(state));
  CHECK(unguided_share(resumed) == unguided_share(state));
  CHECK(unguided_share(forgetful) != unguided_share(state));
}

TEST_CASE("guiding state: methods that share a model still share it when loaded") {
  GuidingState state(settings(), {}), resumed(settings(), {});
  state.absorb(path_to_light(1));
  state.update({0, 1});
  load_from(saved(state), resumed);
  CHECK(resumed.model(0) == resumed.model(1));
  CHECK(resumed.model(0) != resumed.model(2));
}

TEST_CASE("guiding state: saved before anything is known") {
  GuidingState state(settings(), {}), resumed(settings(), {});
  state.absorb(path_to_light(1));
  load_from(saved(state), resumed);
  CHECK(resumed.frame() == nullptr);
  CHECK(resumed.model(0) == nullptr);
  for (GuidingState* s : {&state, &resumed}) s->update({0, 0});
  CHECK(saved(resumed) == saved(state));
  CHECK(resumed.model(0)->density({}) == 1);
}

TEST_CASE("guiding state: cut off anywhere, it is refused") {
  GuidingState state(settings(), {});
  state.absorb(path_to_light(1));
  state.update({0, 1});
  const std::string file = saved(state);
  for (std::size_t size = 0; size < file.size(); ++size) {
    GuidingState resumed(settings(), {});
    CHECK_THROWS_AS(load_from(file.substr(0, size), resumed), InputError);
  }
}

TEST_CASE(
    "guiding state: methods that are never asked take no part; without any there is no frame") {
  GuidingSettings own = settings();
  const auto methods_at_lens = [&](std::size_t silent) {
    own.mixing = std::make_shared<const TinyMixing>(silent);
    GuidingState state(own, {});
    state.absorb(path_to_light(1));
    state.update({0, 1});
    if (state.frame() == nullptr) return std::vector<std::uint32_t>();
    GuidingQuery query{.current = {.kind = VertexKind::sensor}};
    Arena arena;
    std::vector<std::uint32_t> methods;
    for (const GuidePart& part : state.frame()->query(query, arena).parts) {
      methods.push_back(part.method);
    }
    return methods;
  };
  CHECK(methods_at_lens(0) == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(methods_at_lens(2) == std::vector<std::uint32_t>{2});
  CHECK(methods_at_lens(3).empty());
}

/// Ends an iteration of paths that guides have drawn. Returns whether training may end.
bool may_end(GuidingState& state, std::span<const double> guides, double spent,
             std::uint64_t seed) {
  for (std::uint64_t unit = 0; unit < 100; ++unit) {
    state.absorb(test::guided_paths(guides, 1000, 100 * seed + unit));
  }
  return state.may_end_training(spent);
}
bool may_end(GuidingState& state, double guide, double spent, std::uint64_t seed) {
  return may_end(state, std::array{guide}, spent, seed);
}

TEST_CASE("guiding state: training ends when another iteration does not pay, or goes on") {
  GuidingSettings own = settings();
  for (const double tolerance : {0.0, 0.02}) {
    own.training.tolerance = tolerance;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
    state.update({0, 1});
    CHECK_FALSE(may_end(state, 0.5, 0.12, 2));  // there is nothing to compare with
    state.update({1, 1});
    CHECK_FALSE(may_end(state, 0.9, 0.14, 3));  // a rise
    state.update({2, 1});
    CHECK(may_end(state, 0.9, 0.16, 4) == (tolerance > 0));  // none
    state.update({3, 0});
    CHECK(state.frame() != nullptr);
  }
}

TEST_CASE("guiding state: the more another iteration costs, the more it must promise") {
  GuidingSettings own = settings();
  own.training.tolerance = 0.001;
  own.training.trial = 0;
  own.training.share = 0.9;
  own.training.schedule = ScheduleKind::geometric;
  // The noise falls to 0.647, and the gain rises by less than it would have to for as much.
  const double fall = -std::log(test::expected_ratio(0.6));
  REQUIRE(test::expected_gain(0.6) - test::expected_gain(0.5) < fall);
  const auto ends = [&](double time) {
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0, 1));
    state.update({0, 1});
    CHECK_FALSE(may_end(state, 0.5, 0, 2));
    state.update({1, 1});
    return may_end(state, 0.6, time, 3);
  };
  // After t, the next iteration takes 2 t, or all that is left if 4 t would not fit after it.
  REQUIRE(std::log((1 - 0.1 - 0.1) / (1 - 0.1 - 0.2)) < 0.9 * fall);
  CHECK_FALSE(ends(0.1));
  REQUIRE(std::log((1 - 0.25 - 0.325) / (1 - 0.25 - 0.65)) > 1.1 * fall);
  CHECK(ends(0.25));
  // If images are discarded, all of the time is lost.
  own.training.images = TrainingImages::discard;
  REQUIRE(std::log((1 - 0.2) / (1 - 0.2 - 0.7)) > 1.1 * fall);
  CHECK(ends(0.2));
  CHECK_FALSE(ends(0.05));
  // A uniform schedule goes on with as much as the last time.
  own.training.schedule = ScheduleKind::uniform;
  REQUIRE(std::log((1 - 0.2) / (1 - 0.2 - 0.2)) < 0.9 * fall);
  CHECK_FALSE(ends(0.2));
}

/// Returns the methods that are asked at the lens.
std::vector<std::uint32_t> asked_methods(const GuidingState& state) {
  std::vector<std::uint32_t> methods;
  GuidingQuery query{.current = {.kind = VertexKind::sensor}};
  Arena arena;
  for (const GuidePart& part : state.frame()->query(query, arena).parts) {
    methods.push_back(part.method);
  }
  return methods;
}
using Methods = std::vector<std::uint32_t>;

/// The first method helps, the second does nothing, and the third harms.
constexpr std::array kUnequal{0.9, 0.5, 0.1};

TEST_CASE("guiding state: methods that the guides can do without are left out, one by one") {
  GuidingSettings own = settings();
  own.training.least_part = 0.01;
  GuidingState state(own, {}), resumed(own, {});
  CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
  state.update({0, 9});
  may_end(state, kUnequal, 0.2, 2);
  state.update({1, 8});
  const std::string early = saved(state);
  CHECK(asked_methods(state) == Methods{0, 1, 2});  // once is not enough
  may_end(state, kUnequal, 0.3, 3);
  state.update({2, 7});
  CHECK(asked_methods(state) == Methods{0, 1});
  load_from(saved(state), resumed);
  for (GuidingState* each : {&state, &resumed}) {
    const std::string out = saved(*each->model(2)), in = saved(*each->model(0));
    may_end(*each, std::array{0.9, 0.5, -1.0}, 0.35, 4);
    each->update({3, 6});
    CHECK(asked_methods(*each) == Methods{0});
    CHECK(saved(*each->model(2)) == out);  // it learns no more
    // The second method is out, too, but it shares the model of the first.
    CHECK(saved(*each->model(0)) != in);
    for (const std::uint32_t i : {4u, 5u, 6u}) {
      may_end(*each, std::array{0.2, -1.0, -1.0}, 0.4, i);
      each->update({i, 6 - i});
    }
    CHECK(asked_methods(*each) == Methods{0});  // the last one stays
  }
  CHECK(saved(state) == saved(resumed));
  load_from(early, resumed);
  CHECK(asked_methods(resumed) == Methods{0, 1, 2});
}

TEST_CASE("guiding state: no method is left out on trial, by useless guides, or if none is to be") {
  const auto asked = [](double least_part, double least_gain, double spent) {
    GuidingSettings own = settings();
    own.training.tolerance = 1e-9;
    own.training.least_part = least_part;
    own.training.least_gain = least_gain;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0, 1));
    state.update({0, 9});
    for (const std::uint32_t i : {1u, 2u}) {
      may_end(state, kUnequal, i == 2 ? spent : 0, i);
      state.update({i, 9});
    }
    return asked_methods(state);
  };
  CHECK(asked(0.01, 0, 0.1) == Methods{0, 1});
  CHECK(asked(0.01, 0, 0.05) == Methods{0, 1, 2});
  CHECK(asked(0.01, 0.5, 0.1) == Methods{0, 1, 2});
  CHECK(asked(0, 0, 0.1) == Methods{0, 1, 2});
}

TEST_CASE("guiding state: the policy hears of a method that is left out, before its update") {
  GuidingSettings own = settings();
  own.training.least_part = 0.01;
  const auto heard = std::make_shared<std::vector<std::string>>();
  own.mixing = std::make_shared<const TinyMixing>(0, heard);
  GuidingState state(own, {});
  CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
  state.update({0, 9});
  for (const std::uint32_t i : {1u, 2u}) {
    may_end(state, kUnequal, 0.2, i);
    state.update({i, 9});
  }
  CHECK(*heard == std::vector<std::string>{"update", "update", "update", "leave out 2", "update"});
}

TEST_CASE("guiding state: guides of little gain stay if they lower the noise enough") {
  GuidingSettings own = settings();
  own.training.least_gain = 0.2;
  REQUIRE(test::expected_gain(0.8) < 0.2);
  REQUIRE(test::expected_ratio(0.8) < 0.2);
  for (const double most : {0.0, 0.5}) {
    own.training.most_noise = most;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
    state.update({0, 3});
    CHECK_FALSE(may_end(state, 0.8, 0.2, 2));
    CHECK(state.worthwhile_share() == (most > 0 ? 1 : own.training.trial));
    state.update({1, 0});
    CHECK((state.frame() == nullptr) == (most == 0));
    REQUIRE(state.gain());
    CHECK(state.gain()->is_off == (most == 0));
    REQUIRE(state.gain()->noise_ratio);
    CHECK(*state.gain()->noise_ratio ==
          doctest::Approx(test::expected_ratio(0.8)).epsilon(0.05).scale(0));
  }
}

TEST_CASE("guiding state: a guide that hardly helps is off after training, which ends early") {
  GuidingSettings own = settings();
  for (const double least : {0.1, 0.2}) {
    REQUIRE(test::expected_gain(0.9) == doctest::Approx(0.125).epsilon(0.01));
    own.training.least_gain = least;
    own.training.trial = 0.15;
    GuidingState state(own, {});
    CHECK_FALSE(may_end(state, 0.5, 0.1, 1));
    CHECK(state.worthwhile_share() == 1);  // nothing is known: no guide had a model
    state.update({0, 3});
    CHECK_FALSE(may_end(state, 0.5, 0.2, 2));  // there is nothing to compare with
    CHECK(state.worthwhile_share() == 0.15);
    state.update({1, 2});
    CHECK_FALSE(may_end(state, 0.9, 0.25, 3));  // another such rise would suffice
    CHECK(state.worthwhile_share() == (least > 0.125 ? 0.15 : 1));
    state.update({2, 1});
    CHECK(state.frame() != nullptr);         // it may still improve
    CHECK(test::expected_gain(0.8) < 0.11);  // less than before, so the gain does not rise
    CHECK(may_end(state, 0.8, 0.3, 4) == (least > 0.125));
    state.update({3, 0});
    CHECK((state.frame() == nullptr) == (least > 0.125));
    REQUIRE(state.gain().has_value());
    CHECK(state.gain()->is_off == (least > 0.125));
    CHECK(state.gain()->nats == doctest::Approx(test::expected_gain(0.8)).epsilon(0.05));
  }
}

}  // namespace pharos
