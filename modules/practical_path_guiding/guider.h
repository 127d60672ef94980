#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

#include "model.h"

namespace pharos::practical_path_guiding {

/// Samples the directional densities of an SD-tree (Mueller et al. 2017).
class PracticalPathGuidingGuider final : public GuiderOf<PracticalPathGuidingModel> {
 public:
  using Settings = NoSettings;
  explicit PracticalPathGuidingGuider(const Settings&) {}

  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const PracticalPathGuidingModel& model,
                                   const GuidingQuery& query, Arena& arena) const override;
};

}  // namespace pharos::practical_path_guiding
