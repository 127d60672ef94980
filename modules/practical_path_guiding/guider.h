#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

namespace pharos::practical_path_guiding {

/// Samples the directional densities of an SD-tree (Mueller et al. 2017).
class PracticalPathGuidingGuider final : public Guider {
 public:
  using Settings = NoSettings;
  explicit PracticalPathGuidingGuider(const Settings&) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;
};

}  // namespace pharos::practical_path_guiding
