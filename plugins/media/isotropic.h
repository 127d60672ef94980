#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/medium.h>

namespace pharos {

/// See isotropic.cpp.
class IsotropicPhase final : public PhaseFunction {
 public:
  using Settings = NoSettings;
  explicit IsotropicPhase(const Settings& = {}) {}

  float evaluate(Vec3 wo, Vec3 wi) const override;
  Vec3 sample(Vec3 wo, Vec2 u) const override;
  float mean_cosine() const override { return 0; }
};

}  // namespace pharos
