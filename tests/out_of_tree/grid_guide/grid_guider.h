#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

#include "grid_model.h"

namespace grid_guide {

/// Samples the directions of light of the cell.
class GridGuider final : public pharos::GuiderOf<GridModel> {
 public:
  using Settings = pharos::NoSettings;
  explicit GridGuider(const Settings& = {}) {}

  pharos::GuiderTraits traits() const override { return {}; }
  const pharos::GuidingDistribution* query(const GridModel& model,
                                           const pharos::GuidingQuery& query,
                                           pharos::Arena& arena) const override;
};

}  // namespace grid_guide
