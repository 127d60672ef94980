// Tests of what a render learns beside its guides.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/saved_bytes.h>
#include <pharos/rendering/render_learning.h>

#include "tiny_methods.h"
#include "two_directions.h"

namespace pharos {
namespace {

/// The same factor everywhere.
class TinyRule final : public TerminationRule {
 public:
  explicit TinyRule(float factor) : factor_(factor) {}
  BranchFactors factors(const TerminationQuery&) const override { return {factor_}; }

 private:
  float factor_;
};

/// Remembers the size of every log. The number of iterations is the factor.
class TinyTerminationState final : public TerminationState {
 public:
  void absorb(const PathLog& log) override { sizes_.push_back(log.size()); }
  void update(const TrainingStage&) override { ++iterations_; }
  std::shared_ptr<const TerminationRule> rule() const override {
    return std::make_shared<const TinyRule>(static_cast<float>(iterations_));
  }
  void archive(Archive& archive) override {
    archive(sizes_);
    archive_rule(archive);
  }
  void archive_rule(Archive& archive) override { archive(iterations_); }

 private:
  std::vector<std::uint64_t> sizes_;
  std::uint32_t iterations_ = 0;
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

TEST_CASE(
    "render learning: guides are judged by the time of a step if a rule is learned, otherwise by "
    "the time of a path") {
  GuidingSettings settings = test::tiny_settings();
  settings.training.least_gain = 0.2;
  for (const bool learns_rule : {false, true}) {
    const TinyIntegrator integrator(settings, learns_rule);
    RenderLearning learning(integrator, {});
    // With the rule, paths have three times as many steps, each of which takes twice as long.
    for (const std::uint32_t i : {0u, 1u}) {
      for (std::uint64_t unit = 0; unit < 100; ++unit) {
        learning.absorb(test::guided_paths(i == 0 ? 0.5 : 0.8, 1000, 100 * i + unit));
      }
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

TEST_CASE("render learning: other processes get the rule, without what it was learned from") {
  const TinyIntegrator integrator(std::nullopt, true);
  RenderLearning learning(integrator, {}), other(integrator, {});
  const auto frozen = [&] {
    return saved_bytes([&](Archive& archive) { learning.archive_frozen(archive); });
  };
  const std::size_t size = frozen().size();
  for (const std::uint32_t i : {0u, 1u}) {
    for (int unit = 0; unit < 100; ++unit) learning.absorb({});
    learning.update({i, 1 - i});
  }
  CHECK(frozen().size() == size);
  load_bytes(frozen(), [&](Archive& archive) { other.archive_frozen(archive); });
  REQUIRE(other.rule() != nullptr);
  CHECK(other.rule()->factors({}).steps == 2);
}

}  // namespace pharos
