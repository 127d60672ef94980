#pragma once

#include <pharos/config/schema.h>
#include <pharos/scene/medium.h>

namespace pharos {

/// See henyey_greenstein.cpp.
class HenyeyGreensteinPhase final : public PhaseFunction {
 public:
  struct Settings {
    float g = 0;
    static void describe(Schema<Settings>& s);
  };
  explicit HenyeyGreensteinPhase(const Settings& settings) : g_(settings.g) {}

  float evaluate(Vec3 wo, Vec3 wi) const override;
  Vec3 sample(Vec3 wo, Vec2 u) const override;
  float mean_cosine() const override { return g_; }

 private:
  float g_;
};

}  // namespace pharos
