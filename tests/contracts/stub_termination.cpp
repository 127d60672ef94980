// Stub (i): a termination with the same factors of steps and of light samples at every vertex from
// a certain one on.

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/toolkit/throughput_roulette.h>

#include "stubs.h"

namespace pharos::stubs {
namespace {

class StubRule final : public TerminationRule {
 public:
  StubRule(float factor, float lights, std::uint16_t first)
      : factor_(factor), lights_(lights), first_(first) {}
  float factor(const TerminationQuery& query) const override {
    return query.bounce >= first_ ? factor_ : 1;
  }
  float light_factor(const TerminationQuery& query, float) const override {
    return query.bounce >= first_ ? lights_ : 1;
  }

 private:
  float factor_, lights_;
  std::uint16_t first_;
};

class StubTermination final : public Termination {
 public:
  struct Settings {
    float factor = 1.2f;
    float lights = 1;
    std::uint16_t first = 1;
    static void describe(Schema<Settings>& s) {
      s.field("factor", &Settings::factor, "Expected number of steps").above(0).at_most(100);
      s.field("lights", &Settings::lights, "Expected number of light samples")
          .above(0)
          .at_most(100);
      s.field("first", &Settings::first, "Number of the first vertex that has this factor");
    }
  };
  explicit StubTermination(const Settings& settings) : settings_(settings) {}

  bool learns() const override { return false; }
  std::unique_ptr<TerminationState> begin(const LearningContext&) const override {
    return std::make_unique<FixedTermination>(
        std::make_shared<const StubRule>(settings_.factor, settings_.lights, settings_.first));
  }

 private:
  Settings settings_;
};

}  // namespace

void register_termination(Registry& registry) {
  registry.add<StubTermination>("stub_factor", "The same factor at every vertex");
}

}  // namespace pharos::stubs
