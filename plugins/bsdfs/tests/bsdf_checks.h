#pragma once

#include <cstdint>

#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>
#include <pharos/statistics/goodness_of_fit.h>

/// What the suites of this folder share.
namespace pharos::test {

/// The same colour everywhere.
class UniformTexture final : public Texture {
 public:
  explicit UniformTexture(Rgb value) : value_(value) {}
  Rgb evaluate(const SurfacePoint&) const override { return value_; }
  float maximum() const override { return max_component(value_); }
  Rgb average() const override { return value_; }

 private:
  Rgb value_;
};

Ref<Texture> uniform(Rgb value);

/// The unit direction at polar angle `theta` and azimuth `phi` [degrees].
Vec3 direction(double theta, double phi);

/// Fits sample() to evaluate().pdf.
statistics::DensityFit fit_smooth(const Bsdf& bsdf, Vec3 wo, ScatterOptions options,
                                  std::uint64_t seed);

/// Checks that samples are finite, of an allowed event and that value, pdf and weight agree with
/// evaluate() and discrete().
void check_samples(const Bsdf& bsdf, Vec3 wo, ScatterOptions options);

/// Integral of the smooth value over all directions, mean of the channels [1].
double smooth_albedo(const Bsdf& bsdf, Vec3 wo);

}  // namespace pharos::test
