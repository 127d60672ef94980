#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <pharos/core/simd.h>
#include <pharos/core/vec.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/spatial_gaussian.h>

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

/// The density of truncated_normal() at 0 [1].
inline constexpr auto kTruncatedPeak = static_cast<float>(0.3989422804014327 / kTruncatedMass);

/// Returns where the density of truncated_normal() is not zero.
inline Mask8 within_truncation(const Float8& z) {
  return absolute(z) <= kTruncation;
}

/// Samples a point of a truncated Gaussian from numbers in [0, 1).
inline Point3 truncated_point(const SpatialGaussian& g, Vec2 u, float v) {
  return g.mean + spread(g, {truncated_normal(u.x), truncated_normal(u.y), truncated_normal(v)});
}

/// Returns the probability that a unit normal number is below `z`.
inline double normal_below(double z) {
  return 0.5 * std::erfc(-z / 1.4142135623730951);
}

/// The distribution of a unit normal number within [low, high], for finite limits. It exists if the
/// interval has a positive probability.
class NormalWithin {
 public:
  NormalWithin(double low, double high)
      : low_(normal_below(low)), mass_(normal_below(high) - low_) {}

  bool is_possible() const { return mass_ > 0; }
  /// Maps u in [0, 1) to a number within the limits.
  double at(double u) const { return warp::normal_from_unit(low_ + mass_ * u); }
  /// Returns the density at a number within the limits [1].
  double density(double z) const {
    constexpr double kRootTwoPi = 2.5066282746310005;
    return std::exp(-0.5 * z * z) / (kRootTwoPi * mass_);
  }

 private:
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

  /// Returns whether the ray passes through the truncated conditional. sample() requires it.
  bool is_possible() const { return within().is_possible(); }
  /// Samples a distance from u in [0, 1) [scene units].
  float sample(float u) const { return static_cast<float>(mean_ + deviation_ * within().at(u)); }
  /// The density of sample() [1/scene unit]; 0 if nothing is possible.
  float density(float distance) const {
    const double z = (distance - mean_) / deviation_;
    if (!(distance > 0 && std::abs(z) <= kTruncation)) return 0;
    const NormalWithin along = within();
    return along.is_possible() ? static_cast<float>(along.density(z) / deviation_) : 0.0f;
  }

 private:
  using Double3 = std::array<double, 3>;

  DistancesAlong(const Double3& direction, const Double3& mean)
      : deviation_(1 / std::sqrt(dot3(direction, direction))),
        mean_(dot3(direction, mean) * deviation_ * deviation_) {}

  /// Returns the limits of the whitened distance. They take time, so they are found when needed.
  NormalWithin within() const {
    return {std::clamp<double>(-mean_ / deviation_, -kTruncation, kTruncation), kTruncation};
  }

  static double dot3(const Double3& a, const Double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Double3 whitened_offset(const SpatialGaussian& g, Point3 origin) {
    const Vec3 d = g.mean - origin;
    return whitened(g, {d.x, d.y, d.z});
  }

  double deviation_, mean_;  ///< [scene units]
};

}  // namespace pharos::vertex_triplets
