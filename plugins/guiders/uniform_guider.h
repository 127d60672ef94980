#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

#include "uniform_model.h"

namespace pharos {

/// See uniform_guider.cpp.
class UniformGuider final : public GuiderOf<UniformModel> {
 public:
  using Settings = NoSettings;
  explicit UniformGuider(const Settings& = {}) {}

  GuiderTraits traits() const override { return {.guides_light_paths = true}; }
  const GuidingDistribution* query(const UniformModel& model, const GuidingQuery& query,
                                   Arena& arena) const override;
};

}  // namespace pharos
