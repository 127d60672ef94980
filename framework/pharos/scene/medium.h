#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/ray.h>
#include <pharos/core/rgb.h>
#include <pharos/scene/bsdf.h>

namespace pharos {

/// Contract: how a medium scatters light at a point. Thread-safe. Directions are in world space and
/// point away from the vertex: `wo` points to the previous path vertex, `wi` to the next one.
class PhaseFunction : public Component {
 public:
  static constexpr std::string_view contract_name = "phase_function";

  /// The value [1/sr], which is also the density of sample().
  virtual float evaluate(Vec3 wo, Vec3 wi) const = 0;
  /// Draws a unit direction with the density evaluate() [1/sr].
  virtual Vec3 sample(Vec3 wo, Vec2 u) const = 0;
  /// The mean cosine between the directions of flight before and after, in (-1, 1).
  virtual float mean_cosine() const = 0;
};

/// How far a ray travels in a medium.
struct DistanceSample {
  float t = 0;             ///< distance of the scattering point [scene units] if `scattered`
  bool scattered = false;  ///< false: the ray reaches its end
};

/// The effect of a medium on a ray up to a distance.
struct MediumLeg {
  Rgb transmittance{1};        ///< fraction of light that is left [1]
  float pass_probability = 1;  ///< probability that Medium::sample() gets there [1]
  float scatter_pdf = 0;       ///< density with which Medium::sample() scatters there [1/m]
};

/// Returns the probability with which each color channel decides on a distance. The shares are
/// proportional to the path's throughput and add up to one, so every channel that still carries
/// light can be chosen. A black throughput gives three equal shares.
inline Rgb channel_shares(Rgb throughput) {
  const float sum = throughput.r + throughput.g + throughput.b;
  return sum > 0 && std::isfinite(sum) ? throughput / sum : Rgb(1.0f / 3);
}

/// Contract: what fills a part of space. Thread-safe. A distance is drawn for one channel, which is
/// chosen by `shares` (see channel_shares()). Densities are marginal over the choice of the
/// channel.
class Medium : public Component {
 public:
  static constexpr std::string_view contract_name = "medium";

  /// Draws whether and where the ray scatters before `ray.t_max`, which may be infinite. The end of
  /// the ray only cuts the draws off; neither they nor leg() depend on it in any other way.
  virtual DistanceSample sample(const Ray& ray, Rgb shares, float u_channel,
                                float u_distance) const = 0;
  /// Returns the effect of the medium up to distance `t`, which may be infinite.
  virtual MediumLeg leg(const Ray& ray, Rgb shares, float t) const = 0;

  /// The scattering coefficient at a point [1/m].
  virtual Rgb scattering(Point3 position) const = 0;
  virtual const PhaseFunction& phase_function() const = 0;
};

}  // namespace pharos
