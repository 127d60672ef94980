#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/termination.h>

namespace pharos {

/// See none.cpp.
class NoTermination final : public Termination {
 public:
  using Settings = NoSettings;
  explicit NoTermination(const Settings& = {}) {}

  bool learns() const override { return false; }
  std::unique_ptr<TerminationState> begin(const LearningContext&) const override;
};

}  // namespace pharos
