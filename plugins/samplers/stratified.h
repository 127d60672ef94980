#pragma once

#include <pharos/sampling/sampler.h>

#include "set_size.h"

namespace pharos {

/// See stratified.cpp.
class StratifiedSampler final : public Sampler {
 public:
  using Settings = SetSettings;
  explicit StratifiedSampler(const Settings& settings = {}) : settings_(settings) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan& plan) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
