// spot: light from a single point about the axis +z of its own space. Up to the angle `beam_width`
// from the axis it sends `intensity` [W/sr]; beyond `cutoff_angle` it sends nothing. In between the
// intensity decreases
//
//     linear:  with the angle, (c - a) / (c - b), as in Mitsuba 0.6
//     smooth:  with a Hermite step 3 t^2 - 2 t^3 in t = (cos a - cos c) / (cos b - cos c), as in
//     pbrt
//
// where b is the beam's width, c the cutoff and a the angle from the axis. Both angles are measured
// from the axis: a cutoff of 20 degrees makes a cone 40 degrees wide. A cutoff below 0.001 degrees
// is rejected, because single precision resolves directions to about 0.00001. A path cannot hit the
// light by chance; only next event estimation finds it.
//
//     emitters:
//       - { type: spot, intensity: 8, cutoff_angle: 25, beam_width: 15,
//           to_world: { look_at: { origin: [0, 0, 3], target: [0, 0, 0], up: [0, 1, 0] } } }

#include "spot.h"

#include <numbers>

#include <fmt/core.h>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>
#include <pharos/scene/reach.h>

#include "local_light.h"

namespace pharos {
namespace {

class SpotLight final : public Light {
 public:
  explicit SpotLight(const SpotEmitter::Settings& settings)
      : intensity_(settings.scale * settings.intensity),
        position_(settings.to_world.point({})),
        axis_(normalize(settings.to_world.vector({0, 0, 1}))),
        falloff_(settings.falloff),
        beam_(radians(settings.beam_width)),
        cutoff_(radians(settings.cutoff_angle)),
        one_minus_cutoff_(2 * square(std::sin(0.5f * cutoff_))) {}

  LightSample sample(Point3 from, Vec2) const override {
    return local_sample(position_, from,
                        [this](Vec3 direction) { return share(direction) * intensity_; });
  }

  EmissionSample sample_emission(Vec2, Vec2 u_direction) const override {
    const Vec3 local = warp::cone_from_square(u_direction, one_minus_cutoff_);
    const Vec3 direction = Frame::from_normal(axis_).to_world(local);
    return local_emission(position_, direction, warp::cone_pdf(one_minus_cutoff_),
                          share(direction) * intensity_);
  }
  EmissionDensity pdf_emission(const SurfacePoint&, Vec3 direction) const override {
    return {1, share(direction) > 0 ? warp::cone_pdf(one_minus_cutoff_) : 0};
  }

  float power() const override {
    return static_cast<float>(2 * std::numbers::pi * integrated_share()) * mean(intensity_);
  }

 private:
  /// The share [1] of the intensity that is sent in `direction`.
  float share(Vec3 direction) const {
    // The arc tangent keeps the digits of small angles, which the arc cosine loses.
    const float angle = std::atan2(length(cross(axis_, direction)), dot(axis_, direction));
    if (angle <= beam_) return 1;
    if (angle >= cutoff_) return 0;
    if (falloff_ == SpotFalloff::linear) return (cutoff_ - angle) / (cutoff_ - beam_);
    const float t = above_cutoff(angle) / above_cutoff(beam_);
    return t * t * (3 - 2 * t);
  }

  /// Half of cos a - cos c for an `angle` a up to the cutoff c. The product form is used because
  /// the difference has no digits left if both angles are small.
  float above_cutoff(float angle) const {
    return std::sin(0.5f * (cutoff_ + angle)) * std::sin(0.5f * (cutoff_ - angle));
  }

  /// The integral of share() over solid angle, divided by 2 pi [sr].
  double integrated_share() const {
    const double b = beam_, c = cutoff_;
    if (falloff_ == SpotFalloff::smooth) {
      const double sin_b = std::sin(b / 2), sin_c = std::sin(c / 2);
      return sin_b * sin_b + sin_c * sin_c;  // 1 - (cos b + cos c) / 2
    }
    // The integral is 1 - (sin c - sin b) / (c - b). The form below also holds for b = c.
    const double half = (c - b) / 2;
    const double sinc = half > 0 ? std::sin(half) / half : 1;
    return 1 - std::cos((b + c) / 2) * sinc;
  }

  Rgb intensity_;
  Point3 position_;
  Vec3 axis_;
  SpotFalloff falloff_;
  float beam_, cutoff_;     ///< [radians]
  float one_minus_cutoff_;  ///< 1 - cos of the cutoff
};

}  // namespace

void SpotEmitter::Settings::describe(Schema<Settings>& s) {
  s.field("intensity", &Settings::intensity, "Intensity within the beam").unit("W/sr").at_least(0);
  s.field("cutoff_angle", &Settings::cutoff_angle,
          "Angle from the axis beyond which no light is sent")
      .unit("degrees")
      .at_least(0.001)
      .at_most(180);
  s.field("beam_width", &Settings::beam_width,
          "Angle from the axis up to which the intensity is constant; at most cutoff_angle")
      .unit("degrees")
      .at_least(0);
  s.field("falloff", &Settings::falloff,
          "How the intensity decreases from beam_width to cutoff_angle");
  s.field("to_world", &Settings::to_world,
          "From the light's space, where it shines along +z, to world space");
  s.field("scale", &Settings::scale, "Factor on the intensity").at_least(0);
  s.example("{ cutoff_angle: 60, beam_width: 0, falloff: smooth }");
  s.example("{ cutoff_angle: 5, beam_width: 5, intensity: [2, 8, 2], scale: 10 }");
}

SpotEmitter::SpotEmitter(const Settings& settings) : settings_(settings) {
  if (settings.beam_width > settings.cutoff_angle) {
    throw InputError(fmt::format("spot: 'beam_width' must be at most 'cutoff_angle', got {} and {}",
                                 settings.beam_width, settings.cutoff_angle));
  }
  check_reach(settings.to_world.point({}), "the light");
}

std::unique_ptr<const Light> SpotEmitter::place(const EmitterSite&) const {
  return std::make_unique<const SpotLight>(settings_);
}

}  // namespace pharos
