// Stub (i): a termination with the same factors of steps and of light samples at every vertex of a
// range.

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/toolkit/throughput_roulette.h>

#include "stubs.h"

namespace pharos::stubs {
namespace {

class StubRule final : public TerminationRule {
 public:
  StubRule(float factor, float lights, std::uint16_t first, std::uint16_t last)
      : factor_(factor), lights_(lights), first_(first), last_(last) {}
  BranchFactors factors(const TerminationQuery& query) const override {
    return applies_at(query.bounce) ? BranchFactors{factor_, lights_} : BranchFactors{};
  }

 private:
  bool applies_at(std::uint16_t vertex) const { return vertex >= first_ && vertex <= last_; }

  float factor_, lights_;
  std::uint16_t first_, last_;
};

class StubTermination final : public Termination {
 public:
  struct Settings {
    float factor = 1.2f;
    float lights = 1;
    std::uint16_t first = 1, last = 1000;
    static void describe(Schema<Settings>& s) {
      s.field("factor", &Settings::factor, "Expected number of steps").above(0).at_most(100);
      s.field("lights", &Settings::lights, "Expected number of light samples")
          .above(0)
          .at_most(100);
      s.field("first", &Settings::first, "Number of the first vertex that has these factors");
      s.field("last", &Settings::last, "Number of the last vertex that has these factors");
    }
  };
  explicit StubTermination(const Settings& settings) : settings_(settings) {}

  bool learns() const override { return false; }
  std::unique_ptr<TerminationState> begin(const LearningContext&) const override {
    return std::make_unique<FixedTermination>(std::make_shared<const StubRule>(
        settings_.factor, settings_.lights, settings_.first, settings_.last));
  }

 private:
  Settings settings_;
};

}  // namespace

void register_termination(Registry& registry) {
  registry.add<StubTermination>("stub_factor", "The same factor at every vertex");
}

}  // namespace pharos::stubs
