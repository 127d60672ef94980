#pragma once

#include <pharos/sampling/sampler.h>

#include "set_size.h"

namespace pharos {

/// See z_sobol.cpp.
class ZSobolSampler final : public Sampler {
 public:
  using Settings = SetSettings;
  explicit ZSobolSampler(const Settings& settings = {}) : settings_(settings) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan& plan) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
