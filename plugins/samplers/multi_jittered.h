#pragma once

#include <pharos/sampling/sampler.h>

#include "set_size.h"

namespace pharos {

/// See multi_jittered.cpp.
class MultiJitteredSampler final : public Sampler {
 public:
  struct Settings {
    std::optional<std::uint32_t> samples;
    bool correlated = true;
    static void describe(Schema<Settings>& s);
  };
  explicit MultiJitteredSampler(const Settings& settings) : settings_(settings) {}
  MultiJitteredSampler() : MultiJitteredSampler(Settings{}) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan& plan) const override;

 private:
  Settings settings_;
};

}  // namespace pharos
