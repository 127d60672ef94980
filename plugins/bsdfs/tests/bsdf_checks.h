#pragma once

#include <cstdint>
#include <string>

#include <pharos/config/registry.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/texture.h>
#include <pharos/statistics/goodness_of_fit.h>

/// Helpers shared by the test suites of this folder.
namespace pharos::test {

/// The same color everywhere; in YAML a number or color stands for it.
class UniformTexture final : public Texture {
 public:
  struct Settings {
    Rgb value;
    static void describe(Schema<Settings>& s);
  };
  explicit UniformTexture(const Settings& settings) : value_(settings.value) {}
  Rgb value_at(const SurfacePoint&) const override { return value_; }
  Rgb maximum() const override { return value_; }
  Rgb average() const override { return value_; }

 private:
  Rgb value_;
};

Ref<Texture> uniform(Rgb value);

/// The plugins of this folder, with UniformTexture in place of the textures module.
const Registry& registry();

/// Builds a BSDF from YAML, as if from a file "test". Throws InputError.
Ref<Bsdf> build(const std::string& yaml, BuildContext context = {registry()});

/// The unit direction at polar angle `theta` and azimuth `phi` [degrees].
Vec3 direction(double theta, double phi);

/// The density D of GGX in the form of Walter et al. 2007, eq. 33, and its Smith Lambda (Heitz
/// 2014, eq. 72), both in double precision.
double ggx(Vec3 m, double alpha);
double smith_lambda(Vec3 w, double alpha);

/// The density D and Smith Lambda of Beckmann's distribution in the forms of Walter et al. 2007,
/// eqs. 25 and 26.
double beckmann(Vec3 m, double alpha);
double beckmann_lambda(Vec3 w, double alpha);

/// Compares the directions of sample() with the density evaluate().pdf.
statistics::DensityFit fit_smooth(const Bsdf& bsdf, Vec3 wo, ScatterOptions options,
                                  std::uint64_t seed);

/// Checks that samples are finite, that their events are allowed, and that value, pdf and weight
/// agree with evaluate() and discrete().
void check_samples(const Bsdf& bsdf, Vec3 wo, ScatterOptions options);

/// The integral of the smooth value over all directions, mean of the channels [1].
double smooth_albedo(const Bsdf& bsdf, Vec3 wo, ScatterOptions options = {});

}  // namespace pharos::test
