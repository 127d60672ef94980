#pragma once

#include <pharos/config/registry.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// See halton.cpp.
class HaltonSampler final : public Sampler {
 public:
  using Settings = NoSettings;
  explicit HaltonSampler(const Settings& = {}) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
};

}  // namespace pharos
