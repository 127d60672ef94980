#pragma once

#include <cstdint>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/termination.h>

namespace pharos {

/// See throughput.cpp.
class ThroughputTermination final : public Termination {
 public:
  struct Settings {
    std::uint16_t depth = 5;
    float limit = 0.95f;
    static void describe(Schema<Settings>& s);

    std::shared_ptr<const TerminationRule> rule() const;
  };
  explicit ThroughputTermination(const Settings& settings) : settings_(settings) {}

  bool learns() const override { return false; }
  std::unique_ptr<TerminationState> begin(const LearningContext&) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
