#pragma once

#include <pharos/config/registry.h>
#include <pharos/scene/medium.h>

namespace pharos {

/// See homogeneous.cpp.
class HomogeneousMedium final : public Medium {
 public:
  struct Settings {
    Rgb scattering{1}, absorption{0};
    float scale = 1;
    Ref<PhaseFunction> phase;
    static void describe(Schema<Settings>& s);
  };
  explicit HomogeneousMedium(const Settings& settings);

  DistanceSample sample(const Ray& ray, Rgb shares, float u_channel,
                        float u_distance) const override;
  MediumLeg leg(const Ray& ray, Rgb shares, float t) const override;
  Rgb scattering(Point3) const override { return scattering_; }
  const PhaseFunction& phase_function() const override { return *phase_; }

 private:
  bool scatters() const { return !is_black(scattering_); }

  Rgb scattering_;  ///< [1/m]
  Rgb extinction_;  ///< sum of scattering and absorption [1/m]
  Ref<PhaseFunction> phase_;
};

}  // namespace pharos
