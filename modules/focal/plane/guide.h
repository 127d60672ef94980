#pragma once

#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include <pharos/core/random.h>

namespace pharos::focal::plane {

/// Returns a uniform number in [0, 1) with 53 bits. 24 bits do not suffice, because cells of the
/// quadtree are finer.
inline double uniform_number(RandomStream& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A path from the floor that found light.
struct Path {
  double x = 0;      ///< position on the floor where the path starts [scene units]
  double angle = 0;  ///< angle between its direction and the normal [rad]
  double pdf = 0;    ///< density of the sampled direction, all techniques together [1/rad]
  double value = 0;  ///< value of the estimator: radiance times cosine over `pdf`
};

/// A density of directions at one point of the floor, over angles in (-pi/2, pi/2).
class DirectionDensity {
 public:
  virtual ~DirectionDensity() = default;
  /// Samples an angle [rad] with density pdf().
  virtual double sample(RandomStream& random) const = 0;
  /// Returns the density [1/rad], which integrates to one.
  virtual double pdf(double angle) const = 0;
};

/// Learns from paths how to sample the directions of the next paths.
class Guide {
 public:
  virtual ~Guide() = default;
  /// Learns from the paths that found light in training iteration `iteration`, counted from 0.
  virtual void learn(std::span<const Path> paths, int iteration) = 0;
  /// Returns the density at a point of the floor, or null if the guide has not learned anything.
  /// The guide must outlive the density and must not learn while the density is in use.
  virtual std::unique_ptr<DirectionDensity> at(double x) const = 0;
};

/// A mixture of uniform directions and the directions of a guide. The share of guided directions is
/// `guided_fraction`, or zero without a guide. Each sample comes from one of both techniques,
/// selected at random, and is divided by the density of the mixture. This is multiple importance
/// sampling with the balance heuristic.
class MixedDensity final : public DirectionDensity {
 public:
  MixedDensity(std::unique_ptr<DirectionDensity> guided, double guided_fraction)
      : guided_(std::move(guided)), guided_fraction_(guided_ ? guided_fraction : 0) {}

  double sample(RandomStream& random) const override {
    const bool guided = uniform_number(random) < guided_fraction_;
    return guided ? guided_->sample(random) : std::numbers::pi * (uniform_number(random) - 0.5);
  }
  double pdf(double angle) const override {
    const double uniform = (1 - guided_fraction_) / std::numbers::pi;
    return guided_ ? uniform + guided_fraction_ * guided_->pdf(angle) : uniform;
  }

 private:
  std::unique_ptr<DirectionDensity> guided_;
  double guided_fraction_;
};

}  // namespace pharos::focal::plane
