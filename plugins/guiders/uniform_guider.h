#pragma once

#include <pharos/config/registry.h>
#include <pharos/guiding/contract/guider.h>

namespace pharos {

/// See uniform_guider.cpp.
class UniformGuider final : public Guider {
 public:
  using Settings = NoSettings;
  explicit UniformGuider(const Settings& = {}) {}

  GuiderTraits traits() const override;
  std::unique_ptr<const BoundGuider> bind(std::shared_ptr<const GuidingModel> model) const override;
};

}  // namespace pharos
