#pragma once

#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include <pharos/core/random.h>

namespace pharos::focal::plane {

/// Uniform in [0, 1), 53 bits: cells of the quadtree are finer than what 24 bits tell apart.
inline double uniform_number(RandomStream& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A path from the floor that found light.
struct Path {
  double x = 0;      ///< where on the floor it starts [scene units]
  double angle = 0;  ///< of its direction, from the normal [rad]
  double pdf = 0;    ///< with which the direction was drawn, of all techniques together [1/rad]
  double value = 0;  ///< radiance times cosine over `pdf`: the estimator's value
};

/// A density of directions at one point of the floor, over angles in (-pi/2, pi/2).
class DirectionDensity {
 public:
  virtual ~DirectionDensity() = default;
  /// An angle [rad] with density pdf().
  virtual double sample(RandomStream& random) const = 0;
  /// [1/rad]; integrates to one.
  virtual double pdf(double angle) const = 0;
};

/// What learns from paths where to send the next ones.
class Guide {
 public:
  virtual ~Guide() = default;
  /// Takes in the paths that found light in training iteration `iteration`, counted from 0.
  virtual void learn(std::span<const Path> paths, int iteration) = 0;
  /// The density at a point of the floor; null where the guide knows nothing. The guide must
  /// outlive it, and learn nothing meanwhile.
  virtual std::unique_ptr<DirectionDensity> at(double x) const = 0;
};

/// Uniform directions and a guide's, as one density: the share of guided ones is
/// `guided_fraction`, and none without a guide. Sampling one of both by chance and dividing by the
/// density of the mixture is multiple importance sampling with the balance heuristic.
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
