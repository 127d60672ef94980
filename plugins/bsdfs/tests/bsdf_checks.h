#pragma once

#include <cstdint>
#include <string>

#include <pharos/config/registry.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>
#include <pharos/statistics/goodness_of_fit.h>

/// What the suites of this folder share.
namespace pharos::test {

/// The same color everywhere; a number or color stands for it in YAML.
class UniformTexture final : public Texture {
 public:
  struct Settings {
    Rgb value;
    static void describe(Schema<Settings>& s);
  };
  explicit UniformTexture(const Settings& settings) : value_(settings.value) {}
  Rgb evaluate(const SurfacePoint&) const override { return value_; }
  Rgb maximum() const override { return value_; }
  Rgb average() const override { return value_; }

 private:
  Rgb value_;
};

Ref<Texture> uniform(Rgb value);

/// This folder's plugins, and UniformTexture for the textures of another module.
const Registry& registry();

/// Builds a BSDF from YAML, in a file "test". Throws InputError.
Ref<Bsdf> build(const std::string& yaml, BuildContext context = {registry()});

/// The unit direction at polar angle `theta` and azimuth `phi` [degrees].
Vec3 direction(double theta, double phi);

/// D of GGX in the form of Walter et al. 2007, eq. 33, and Smith's Lambda of it (Heitz 2014, eq.
/// 72), both in double precision.
double ggx(Vec3 m, double alpha);
double smith_lambda(Vec3 w, double alpha);

/// The same of Beckmann's distribution, in the forms of Walter et al. 2007, eqs. 25 and 26.
double beckmann(Vec3 m, double alpha);
double beckmann_lambda(Vec3 w, double alpha);

/// Fits sample() to evaluate().pdf.
statistics::DensityFit fit_smooth(const Bsdf& bsdf, Vec3 wo, ScatterOptions options,
                                  std::uint64_t seed);

/// Checks that samples are finite, of an allowed event and that value, pdf and weight agree with
/// evaluate() and discrete().
void check_samples(const Bsdf& bsdf, Vec3 wo, ScatterOptions options);

/// Integral of the smooth value over all directions, mean of the channels [1].
double smooth_albedo(const Bsdf& bsdf, Vec3 wo, ScatterOptions options = {});

}  // namespace pharos::test
