// Terminations: a planted fault makes exactly the checks fail that are meant to find it.

#include <atomic>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/config/module_loader.h>
#include <pharos/guiding/contract/termination.h>

#include "planted_faults.h"

namespace pharos {
namespace {

enum class RuleFault { none, negative, undefined, huge, huge_lights, moods, forgets };

using Settings = test::FaultSettings<RuleFault>;

/// Splits more, the more paths were learned.
class FaultyRule final : public TerminationRule {
 public:
  explicit FaultyRule(double paths) : paths_(static_cast<float>(paths)) {}

  BranchFactors factors(const TerminationQuery&) const override {
    switch (Settings::planted) {
      case RuleFault::negative:
        return {-1};
      case RuleFault::undefined:
        return {std::numeric_limits<float>::quiet_NaN()};
      case RuleFault::huge:
        return {1e9f};
      case RuleFault::huge_lights:
        return {1, kInfinity};
      case RuleFault::moods:
        return {asked_++ % 2 == 0 ? 1 : 1.01f};
      default:
        return {1 + 1e-6f * paths_};
    }
  }

 private:
  float paths_;
  static inline std::atomic<int> asked_{0};
};

class FaultyState final : public TerminationState {
 public:
  void absorb(const PathLog& log) override { paths_ += static_cast<double>(log.size()); }
  void update(const TrainingStage&) override {}
  std::shared_ptr<const TerminationRule> rule() const override {
    return std::make_shared<const FaultyRule>(paths_);
  }
  void archive(Archive& archive) override {
    if (Settings::planted != RuleFault::forgets) archive(paths_);
  }

 private:
  double paths_ = 0;
};

class FaultyTermination final : public Termination {
 public:
  using Settings = test::FaultSettings<RuleFault>;
  explicit FaultyTermination(const Settings&) {}
  bool learns() const override { return true; }
  std::unique_ptr<TerminationState> begin(const LearningContext&) const override {
    return std::make_unique<FaultyState>();
  }
};

/// Returns the failed checks of the termination. `with_plugins`: there are integrators.
conformance::Report report(bool with_plugins) {
  Registry registry;
  if (with_plugins) load_modules(registry, PHAROS_PLUGINS, true);
  registry.add<FaultyTermination>("faulty", "Splits more, the more it has learned");
  return conformance::check_plugins(registry, {.names = {"faulty"}});
}

std::string red_rule(RuleFault fault) {
  Settings::planted = fault;
  return test::red(report(true));
}

TEST_CASE("conformance: faults of a termination") {
  CHECK(red_rule(RuleFault::none) == "");
  CHECK(red_rule(RuleFault::moods).find("determinism") != std::string::npos);
  CHECK(red_rule(RuleFault::forgets) == "save_load");
}

TEST_CASE("conformance: factors out of their bounds") {
  for (const RuleFault fault :
       {RuleFault::negative, RuleFault::undefined, RuleFault::huge, RuleFault::huge_lights}) {
    CAPTURE(static_cast<int>(fault));
    CHECK(red_rule(fault).find("factors") != std::string::npos);
  }
}

TEST_CASE("conformance: a termination that no integrator takes") {
  Settings::planted = RuleFault::none;
  for (const conformance::Finding& finding : report(false).findings) {
    if (finding.check == "buildable") continue;
    CHECK(finding.verdict == conformance::Verdict::not_applicable);
  }
}

}  // namespace
}  // namespace pharos
