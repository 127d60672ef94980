#pragma once

#include <pharos/config/schema.h>
#include <pharos/sampling/purpose_names.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// See sheared.cpp.
class ShearedSampler final : public Sampler {
 public:
  struct Settings {
    Ref<Sampler> base;
    double direction = 45;
    Purpose purpose = Purpose::light_position;
    static void describe(Schema<Settings>& s);
  };
  explicit ShearedSampler(const Settings& settings) : settings_(settings) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan& plan) const override {
    return settings_.base->preferred_samples(plan);
  }
  bool needs_probe() const override { return settings_.base->needs_probe(); }

 private:
  Settings settings_;
};

}  // namespace pharos
