#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

namespace pharos::focal {

/// Samples directions through focal points: aims at converging ones and away from diverging ones.
class FocalGuider final : public Guider {
 public:
  using Settings = NoSettings;
  explicit FocalGuider(Settings) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;
};

}  // namespace pharos::focal
