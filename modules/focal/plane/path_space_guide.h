#pragma once

#include <vector>

#include "guide.h"

namespace pharos::focal::plane {

/// The position of a kernel's mean.
enum class KernelCenter {
  guide_path,  ///< the guide path (Reibold et al.)
  neighbors,   ///< the mean of the guide path's neighbors (the focal authors' demonstration): an
               ///< isolated path next to a cluster makes a kernel in the cluster, and no density at
               ///< its own position
};

/// The parameters of PathSpaceGuide.
struct PathSpaceSettings {
  int neighbors = 10;  ///< number of paths that determine a kernel, including the guide path
  KernelCenter center = KernelCenter::guide_path;
  double least_deviation = 1e-4;  ///< least standard deviation of a kernel along the floor and
                                  ///< along the light [scene units]
  bool accumulate = false;        ///< keeps guide paths of all iterations, not only of the last one
};

/// Returns a standard normal number, by the Box-Muller transform of two random numbers.
double normal_number(RandomStream& random);

/// Guiding by complete paths, after Reibold et al. 2018, "Selective Guided Sampling with Complete
/// Light Transport Paths", reduced to this scene. A path is a pair of points: its start on the
/// floor (x0) and its end on the light (x1). Every path that found light is a guide path. It
/// becomes a Gaussian over such pairs. The covariance of the Gaussian is the covariance of the
/// path's nearest neighbors about the center of the Gaussian, and its weight is the path's value.
/// At a point x0 of the floor, a Gaussian is chosen in proportion to its weight times its density
/// at x0. Then x1 is sampled from this Gaussian given x0. The paper keeps only guide paths that
/// cause variance and truncates the Gaussians. Here, the guide paths are few, and the mixture with
/// uniform sampling bounds the estimator.
class PathSpaceGuide final : public Guide {
 public:
  explicit PathSpaceGuide(double light_height, const PathSpaceSettings& settings = {})
      : light_height_(light_height), settings_(settings) {}

  /// Learns nothing as long as there are fewer paths than a kernel needs.
  void learn(std::span<const Path> paths, int iteration) override;
  std::unique_ptr<DirectionDensity> at(double x) const override;

  /// A path as a pair of points, and its weight.
  struct GuidePath {
    double x0 = 0, x1 = 0;
    double weight = 0;
  };
  const std::vector<GuidePath>& guide_paths() const { return paths_; }

 private:
  /// A Gaussian over pairs, stored as a marginal and a conditional distribution. x0 is normal.
  /// Given x0, x1 is normal about mean1 + slope (x0 - mean0).
  struct Kernel {
    double weight, mean0, deviation0, mean1, slope, deviation1;
  };
  Kernel kernel_of(const GuidePath& path, std::vector<const GuidePath*>& order) const;

  double light_height_;
  PathSpaceSettings settings_;
  std::vector<GuidePath> paths_;
  std::vector<Kernel> kernels_;
};

}  // namespace pharos::focal::plane
