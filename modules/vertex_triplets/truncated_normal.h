#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/vec.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/spatial_mixture.h>

/// Gaussians that end (Schuessler et al. 2022, section 4.3): along each axis of the Cholesky factor
/// a unit normal number within [-4, 4], zero beyond. They integrate to one by construction.
namespace pharos::vertex_triplets {

inline constexpr float kTruncation = 4;
/// Probability that a unit normal number lies within.
inline constexpr double kTruncatedMass = 0.99993665751633376;

/// The number that belongs to u in [0, 1).
inline float truncated_normal(float u) {
  constexpr auto kTail = static_cast<float>(0.5 * (1 - kTruncatedMass));
  const float z = warp::fast_normal_from_unit(kTail + static_cast<float>(kTruncatedMass) * u);
  return std::clamp(z, -kTruncation, kTruncation);
}

/// Its density [1].
inline float truncated_normal_density(float z) {
  constexpr double kRootTwoPi = 2.5066282746310005;
  constexpr auto kScale = static_cast<float>(1 / (kRootTwoPi * kTruncatedMass));
  return std::abs(z) <= kTruncation ? kScale * std::exp(-0.5f * z * z) : 0.0f;
}

/// A point of a truncated Gaussian from numbers in [0, 1).
inline Point3 truncated_point(const SpatialGaussian& g, Vec2 u, float v) {
  return g.mean + spread(g, {truncated_normal(u.x), truncated_normal(u.y), truncated_normal(v)});
}

/// Its density at a point [1/scene unit^3].
inline float truncated_density(const SpatialGaussian& g, Point3 point) {
  const Vec3 d = point - g.mean;
  const std::array<double, 3> z = whitened(g, {d.x, d.y, d.z});
  double density = 1 / root_determinant(g);
  for (const double along : z) density *= truncated_normal_density(static_cast<float>(along));
  return static_cast<float>(density);
}

/// A unit normal number within [low, high], any finite limits of a positive probability.
class NormalWithin {
 public:
  NormalWithin(double low, double high) : low_(below(low)), mass_(below(high) - low_) {}

  bool is_possible() const { return mass_ > 0; }
  /// The number that belongs to u in [0, 1).
  double at(double u) const { return warp::normal_from_unit(low_ + mass_ * u); }
  /// The density at a number within the limits [1].
  double density(double z) const {
    constexpr double kRootTwoPi = 2.5066282746310005;
    return std::exp(-0.5 * z * z) / (kRootTwoPi * mass_);
  }

 private:
  static double below(double z) { return 0.5 * std::erfc(-z / 1.4142135623730951); }

  double low_, mass_;
};

/// The distances at which a ray may meet a Gaussian's points: those of the untruncated Gaussian
/// along it, cut at zero and at four standard deviations of themselves (section 5.3). With
/// a = w^T S^-1 w and b = w^T S^-1 (mean - origin) they are normal about b / a with variance 1 / a.
class DistancesAlong {
 public:
  DistancesAlong(const SpatialGaussian& g, Point3 origin, Vec3 direction)
      : DistancesAlong(whitened(g, {direction.x, direction.y, direction.z}),
                       whitened_offset(g, origin)) {}

  bool is_possible() const { return within_.is_possible(); }
  /// A distance from u in [0, 1) [scene units].
  float sample(float u) const { return static_cast<float>(mean_ + deviation_ * within_.at(u)); }
  /// Its density [1/scene unit].
  float density(float distance) const {
    const double z = (distance - mean_) / deviation_;
    const bool is_within = distance > 0 && std::abs(z) <= kTruncation;
    return is_within ? static_cast<float>(within_.density(z) / deviation_) : 0.0f;
  }

 private:
  using Double3 = std::array<double, 3>;

  DistancesAlong(const Double3& direction, const Double3& mean)
      : deviation_(1 / std::sqrt(dot3(direction, direction))),
        mean_(dot3(direction, mean) * deviation_ * deviation_),
        within_(std::clamp<double>(-mean_ / deviation_, -kTruncation, kTruncation), kTruncation) {}

  static double dot3(const Double3& a, const Double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Double3 whitened_offset(const SpatialGaussian& g, Point3 origin) {
    const Vec3 d = g.mean - origin;
    return whitened(g, {d.x, d.y, d.z});
  }

  double deviation_, mean_;  ///< [scene units]
  NormalWithin within_;
};

/// Directions to the points of a Gaussian's projection on the plane through its mean, across the
/// line of sight (section 5.2).
class Projection {
 public:
  Projection() = default;
  Projection(const SpatialGaussian& g, Point3 origin);

  /// False where the mean is nearer than `least`: there is no line of sight.
  bool is_possible(float least) const { return distance_ > least; }
  Vec3 sample(Vec2 u) const;
  /// Its density [1/sr]: q(y) d^2 / cos^3.
  float density(Vec3 direction) const;

 private:
  Vec3 towards_, across_[2];
  float distance_ = 0;
  float cholesky_[3] = {};  ///< of the projected covariance: l00, l10, l11
};

}  // namespace pharos::vertex_triplets
