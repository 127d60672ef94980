#pragma once

#include <pharos/config/registry.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// See pmj02bn.cpp.
class Pmj02bnSampler final : public Sampler {
 public:
  using Settings = NoSettings;
  explicit Pmj02bnSampler(const Settings& = {}) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
};

}  // namespace pharos
