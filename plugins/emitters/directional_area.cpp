// directional_area: a shape that emits most light along its normal. `radiance` [W/(m^2 sr)] times
// `scale` is the peak on the axis. At an angle of cosine c to the geometric normal the radiance is
// multiplied by
//
//     cosine_power:      c^exponent
//     von_mises_fisher:  exp(concentration (c - 1))
//
// Nothing is emitted to the other side. An exponent or concentration of 0 gives a plain `area`;
// with 1000 the radiance drops to half at 2 degrees. Values above 100000 (0.2 degrees) are
// rejected, because the rounding error of a cosine, 6e-8, would change the radiance by half a
// percent. Since the peak is fixed, narrow lobes have less power. The radiant exitance for radiance
// 1 is
//
//     cosine_power:      2 pi / (exponent + 2)
//     von_mises_fisher:  2 pi (k - 1 + exp(-k)) / k^2    with k = concentration
//
//     type: quad
//     emitter: { type: directional_area, radiance: 100, lobe: cosine_power, exponent: 50 }

#include "directional_area.h"

#include <pharos/core/error.h>
#include <pharos/core/warp.h>

#include "area_light.h"

namespace pharos {
namespace {

/// The largest exponent or concentration for which cosines in single precision are accurate enough.
constexpr float kNarrowest = 1e5f;

struct CosinePowerLobe {
  float exponent;

  float operator()(float cosine) const { return std::pow(cosine, exponent); }
  float projected_solid_angle() const { return 2 * kPi / (exponent + 2); }
  /// Inverts the distribution function of the cosine, cosine^(exponent + 2).
  Vec3 sample(Vec2 u) const {
    return warp::about_z(-std::expm1(std::log(1 - u.x) / (exponent + 2)), u.y);
  }
  float pdf(float cosine) const {
    return (exponent + 2) / (2 * kPi) * std::pow(cosine, exponent + 1);
  }
};

struct VonMisesFisherLobe {
  float concentration;

  float operator()(float cosine) const { return std::exp(concentration * (cosine - 1)); }
  float projected_solid_angle() const {
    const double k = concentration;
    constexpr double kSeriesIsBetter =
        1e-3;  // below, the quotient of small differences loses digits
    const double integral = k < kSeriesIsBetter ? 0.5 - k / 6 : (k + std::expm1(-k)) / (k * k);
    return 2 * kPi * static_cast<float>(integral);
  }
  /// Draws in proportion to the factor alone, on the hemisphere; uniform for a concentration of 0.
  Vec3 sample(Vec2 u) const {
    const float k = concentration;
    const float one_minus_cos = k < kUniform ? u.x : -std::log1p(u.x * std::expm1(-k)) / k;
    return warp::about_z(one_minus_cos, u.y);
  }
  float pdf(float cosine) const {
    const float k = concentration;
    if (k < kUniform) return 1 / (2 * kPi);
    return k * std::exp(k * (cosine - 1)) / (-2 * kPi * std::expm1(-k));
  }

  /// Below this value the lobe is uniform within the precision of float.
  static constexpr float kUniform = 1e-6f;
};

}  // namespace

void DirectionalAreaEmitter::Settings::describe(Schema<Settings>& s) {
  describe_radiance(s, "Radiance along the normal");
  s.field("lobe", &Settings::lobe, "How radiance decreases with the angle to the normal");
  s.field("exponent", &Settings::exponent, "Exponent of the cosine, for lobe cosine_power")
      .at_least(0)
      .at_most(kNarrowest);
  s.field("concentration", &Settings::concentration,
          "Narrowness of the lobe, for lobe von_mises_fisher")
      .at_least(0)
      .at_most(kNarrowest);
  s.example("{ radiance: [4, 3, 2], lobe: cosine_power, exponent: 20 }");
  s.example("{ radiance: 5, lobe: von_mises_fisher, concentration: 200, scale: 2 }");
}

DirectionalAreaEmitter::DirectionalAreaEmitter(Settings settings) : settings_(std::move(settings)) {
  const bool cosine = settings_.lobe == EmissionLobe::cosine_power;
  if (settings_.exponent.has_value() == cosine && settings_.concentration.has_value() != cosine) {
    return;
  }
  throw InputError(std::string("directional_area: the lobe ") +
                   (cosine ? "'cosine_power' takes 'exponent' and no 'concentration'"
                           : "'von_mises_fisher' takes 'concentration' and no 'exponent'"));
}

std::unique_ptr<const Light> DirectionalAreaEmitter::place(const EmitterSite& site) const {
  const auto light = [&](auto lobe) -> std::unique_ptr<const Light> {
    return std::make_unique<const AreaLight<decltype(lobe)>>(*settings_.radiance, settings_.scale,
                                                             lobe, site);
  };
  return settings_.lobe == EmissionLobe::cosine_power
             ? light(CosinePowerLobe{*settings_.exponent})
             : light(VonMisesFisherLobe{*settings_.concentration});
}

}  // namespace pharos
