#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/guider.h>

namespace pharos::ppg {

/// Samples the directional densities of an SD-tree (Mueller et al. 2017).
class SdTreeGuider final : public Guider {
 public:
  using Settings = NoSettings;
  explicit SdTreeGuider(const Settings&) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;
};

}  // namespace pharos::ppg
