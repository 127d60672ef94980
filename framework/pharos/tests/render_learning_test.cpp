// Tests of what a render learns beside its guides.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <doctest/doctest.h>

#include <pharos/rendering/render_learning.h>

#include "tiny_methods.h"
#include "two_directions.h"

namespace pharos {
namespace {

/// Learns nothing, but is asked to.
class TinyTerminationState final : public TerminationState {
 public:
  void absorb(const PathLog&) override {}
  void update(const TrainingStage&) override {}
  std::shared_ptr<const TerminationRule> rule() const override { return nullptr; }
  void archive(Archive&) override {}
};

class TinyTermination final : public Termination {
 public:
  bool learns() const override { return true; }
  std::unique_ptr<TerminationState> begin(const LearningContext&) const override {
    return std::make_unique<TinyTerminationState>();
  }
};

/// An integrator that renders nothing.
class TinyIntegrator final : public Integrator {
 public:
  TinyIntegrator(std::optional<GuidingSettings> guiding, bool learns_termination)
      : guiding_(std::move(guiding)), learns_termination_(learns_termination) {}
  IntegratorTraits traits() const override { return {}; }
  const GuidingSettings* guiding() const override { return guiding_ ? &*guiding_ : nullptr; }
  const Termination* learned_termination() const override {
    return learns_termination_ ? &termination_ : nullptr;
  }
  std::unique_ptr<const PreparedIntegrator> prepare(const RenderTarget&) const override {
    return nullptr;
  }

 private:
  std::optional<GuidingSettings> guiding_;
  bool learns_termination_;
  TinyTermination termination_;
};

}  // namespace

TEST_CASE("render learning: the time of steps counts if a rule is learned, else that of paths") {
  GuidingSettings settings = test::tiny_settings();
  settings.training.least_gain = 0.2;
  for (const bool learns_rule : {false, true}) {
    const TinyIntegrator integrator(settings, learns_rule);
    RenderLearning learning(integrator, {});
    // With the rule, paths have three times as many steps, each of which takes twice as long.
    for (const std::uint32_t i : {0u, 1u}) {
      learning.absorb(test::guided_paths(std::array{i == 0 ? 0.5 : 0.8}, 100'000, i));
      learning.may_end_training({.spent = 0.1 * (i + 1),
                                 .samples = 2,
                                 .steps = i == 0 ? 4.0 : 12.0,
                                 .seconds = i == 0 ? 1.0 : 6.0});
      learning.update({i, 3 - i});
    }
    const std::optional<GuideGain> gain = learning.guiding()->gain();
    REQUIRE(gain);
    CHECK(gain->path_cost == doctest::Approx(learns_rule ? 2 : 6));
  }
}

}  // namespace pharos
