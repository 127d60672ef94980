// directional_area: a shape shines, most along its normal. `radiance` [W/(m^2 sr)], times `scale`,
// is the peak on the axis; at an angle of cosine c to the geometric normal it is multiplied by
//
//     cosine_power:      c^exponent
//     von_mises_fisher:  exp(concentration (c - 1))
//
// and nothing goes to the other side. An exponent or concentration of 0 is a plain `area`; 1000
// leaves half of the radiance at 2 degrees. More than 100000, 0.2 degrees, is refused: there the
// rounding of a cosine, 6e-8, moves the radiance by half a percent. As the peak is fixed, narrow
// lobes have less power: the radiant exitance of radiance 1 is
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

/// The largest exponent or concentration for which cosines in single precision are good enough.
constexpr float kNarrowest = 1e5f;

struct CosinePowerLobe {
  float exponent;

  float operator()(float cosine) const { return std::pow(cosine, exponent); }
  float projected_solid_angle() const { return 2 * kPi / (exponent + 2); }
  /// By the inverse of the distribution of the cosine, cosine^(exponent + 2).
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
  /// In proportion to the factor alone, on the hemisphere; uniform for a concentration of 0.
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

  /// Below this, the lobe is even within what floats can tell.
  static constexpr float kUniform = 1e-6f;
};

}  // namespace

void DirectionalAreaEmitter::Settings::describe(Schema<Settings>& s) {
  describe_radiance(s, "Radiance along the normal");
  s.field("lobe", &Settings::lobe, "How radiance goes down with the angle to the normal");
  s.field("exponent", &Settings::exponent, "Power of the cosine; of lobe cosine_power")
      .at_least(0)
      .at_most(kNarrowest);
  s.field("concentration", &Settings::concentration, "Of lobe von_mises_fisher")
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
