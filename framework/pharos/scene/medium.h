#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/ray.h>
#include <pharos/core/rgb.h>
#include <pharos/scene/bsdf.h>

namespace pharos {

/// Contract: how a medium scatters where it scatters. Thread-safe. Directions are in world space
/// and point away from the vertex: `wo` to where the path came from, `wi` to where it goes.
class PhaseFunction : public Component {
 public:
  static constexpr std::string_view contract_name = "phase_function";

  /// Value [1/sr]; it is the density of sample() as well.
  virtual float evaluate(Vec3 wo, Vec3 wi) const = 0;
  /// Unit direction drawn with density evaluate() [1/sr].
  virtual Vec3 sample(Vec3 wo, Vec2 u) const = 0;
  /// Mean cosine between the direction of flight before and after, in (-1, 1).
  virtual float mean_cosine() const = 0;
};

/// How far a ray gets in a medium.
struct DistanceSample {
  float t = 0;             ///< distance of the scattering point [scene units] if `scattered`
  bool scattered = false;  ///< false: the ray reaches its end
};

/// How likely each channel is to decide on a distance: shares that add up to one, as those of a
/// path's throughput do, so that no channel is left to chance that still carries light. Of three
/// equal ones for black.
inline Rgb channel_shares(Rgb throughput) {
  const float sum = throughput.r + throughput.g + throughput.b;
  return sum > 0 && std::isfinite(sum) ? throughput / sum : Rgb(1.0f / 3);
}

/// Contract: what fills a part of space. Thread-safe. Distances are drawn for one channel, chosen
/// by `shares` (channel_shares()); densities are those of the choice and the distance together.
class Medium : public Component {
 public:
  static constexpr std::string_view contract_name = "medium";

  /// Draws whether and where the ray scatters before `ray.t_max`.
  virtual DistanceSample sample(const Ray& ray, Rgb shares, float u_channel,
                                float u_distance) const = 0;
  /// The density [1/m] with which sample() scatters at distance t < ray.t_max.
  virtual float scatter_pdf(const Ray& ray, Rgb shares, float t) const = 0;
  /// The probability [1] with which sample() reaches distance t unscattered.
  virtual float pass_probability(const Ray& ray, Rgb shares, float t) const = 0;

  /// Fraction of light left after distance t [1].
  virtual Rgb transmittance(const Ray& ray, float t) const = 0;
  /// Scattering coefficient at a point [1/m].
  virtual Rgb scattering(Point3 position) const = 0;
  virtual const PhaseFunction& phase_function() const = 0;
};

}  // namespace pharos
