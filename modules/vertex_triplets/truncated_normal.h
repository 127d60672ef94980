#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/vec.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/spatial_mixture.h>

/// Truncated Gaussians (Schuessler et al. 2022, section 4.3): along each axis of the Cholesky
/// factor, the whitened coordinate is a unit normal number within [-4, 4]. The density is zero
/// beyond and integrates to one by construction.
namespace pharos::vertex_triplets {

inline constexpr float kTruncation = 4;
/// Probability that a unit normal number is within [-4, 4].
inline constexpr double kTruncatedMass = 0.99993665751633376;

/// Maps u in [0, 1) to a truncated unit normal number.
inline float truncated_normal(float u) {
  constexpr auto kTail = static_cast<float>(0.5 * (1 - kTruncatedMass));
  const float z = warp::fast_normal_from_unit(kTail + static_cast<float>(kTruncatedMass) * u);
  return std::clamp(z, -kTruncation, kTruncation);
}

/// The density of truncated_normal() [1].
inline float truncated_normal_density(float z) {
  constexpr double kRootTwoPi = 2.5066282746310005;
  constexpr auto kScale = static_cast<float>(1 / (kRootTwoPi * kTruncatedMass));
  return std::abs(z) <= kTruncation ? kScale * std::exp(-0.5f * z * z) : 0.0f;
}

/// Samples a point of a truncated Gaussian from numbers in [0, 1).
inline Point3 truncated_point(const SpatialGaussian& g, Vec2 u, float v) {
  return g.mean + spread(g, {truncated_normal(u.x), truncated_normal(u.y), truncated_normal(v)});
}

/// The density of truncated_point() [1/scene unit^3].
inline float truncated_density(const SpatialGaussian& g, Point3 point) {
  const Vec3 d = point - g.mean;
  const std::array<double, 3> z = whitened(g, {d.x, d.y, d.z});
  double density = 1 / root_determinant(g);
  for (const double along : z) density *= truncated_normal_density(static_cast<float>(along));
  return static_cast<float>(density);
}

/// The distribution of a unit normal number within [low, high], for finite limits. It exists if the
/// interval has a positive probability.
class NormalWithin {
 public:
  NormalWithin(double low, double high) : low_(below(low)), mass_(below(high) - low_) {}

  bool is_possible() const { return mass_ > 0; }
  /// Maps u in [0, 1) to a number within the limits.
  double at(double u) const { return warp::normal_from_unit(low_ + mass_ * u); }
  /// Returns the density at a number within the limits [1].
  double density(double z) const {
    constexpr double kRootTwoPi = 2.5066282746310005;
    return std::exp(-0.5 * z * z) / (kRootTwoPi * mass_);
  }

 private:
  static double below(double z) { return 0.5 * std::erfc(-z / 1.4142135623730951); }

  double low_, mass_;
};

/// The distribution of distances along a ray, given a Gaussian (section 5.3): the conditional of
/// the untruncated Gaussian along the ray, cut at zero and at four of its own standard deviations.
/// With a = w^T S^-1 w and b = w^T S^-1 (mean - origin), the conditional has mean b / a and
/// variance 1 / a.
class DistancesAlong {
 public:
  DistancesAlong(const SpatialGaussian& g, Point3 origin, Vec3 direction)
      : DistancesAlong(whitened(g, {direction.x, direction.y, direction.z}),
                       whitened_offset(g, origin)) {}

  bool is_possible() const { return within_.is_possible(); }
  /// Samples a distance from u in [0, 1) [scene units].
  float sample(float u) const { return static_cast<float>(mean_ + deviation_ * within_.at(u)); }
  /// The density of sample() [1/scene unit].
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

/// The distribution of directions to the points of a truncated Gaussian, projected on the plane
/// through its mean that is orthogonal to the line of sight (section 5.2).
class Projection {
 public:
  Projection() = default;
  Projection(const SpatialGaussian& g, Point3 origin);

  /// Returns false if the mean is not farther than `least`, because there is no line of sight then.
  bool is_possible(float least) const { return distance_ > least; }
  Vec3 sample(Vec2 u) const;
  /// The density of sample() [1/sr]: q(y) d^2 / cos^3.
  float density(Vec3 direction) const;

 private:
  Vec3 towards_, across_[2];
  float distance_ = 0;
  float cholesky_[3] = {};  ///< of the projected covariance: l00, l10, l11
};

}  // namespace pharos::vertex_triplets
