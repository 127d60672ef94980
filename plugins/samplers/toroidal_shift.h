#pragma once

#include <pharos/config/component.h>
#include <pharos/config/schema.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// See toroidal_shift.cpp.
class ToroidalShiftSampler final : public Sampler {
 public:
  struct Settings {
    Ref<Sampler> base;
    static void describe(Schema<Settings>& s);
  };
  explicit ToroidalShiftSampler(const Settings& settings) : base_(settings.base) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan& plan) const override {
    return base_->preferred_samples(plan);
  }
  bool needs_probe() const override { return base_->needs_probe(); }

 private:
  Ref<Sampler> base_;
};

}  // namespace pharos
