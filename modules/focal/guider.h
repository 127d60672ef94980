#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

#include "model.h"

namespace pharos::focal {

/// Samples directions toward converging focal points and away from diverging ones (Rath et al.
/// 2023).
class FocalGuider final : public GuiderOf<FocalModel> {
 public:
  using Settings = NoSettings;
  explicit FocalGuider(const Settings& = {}) {}

  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const FocalModel& model, const GuidingQuery& query,
                                   Arena& arena) const override;
};

}  // namespace pharos::focal
