#pragma once

#include <vector>

#include "guide.h"

namespace pharos::focal::plane {

/// The mean of a kernel.
enum class KernelCenter {
  guide_path,  ///< Reibold et al.: Gaussians stand around guide paths
  neighbors,   ///< the mean of the guide path's neighbors (the focal authors' demonstration): a
               ///< lone path beside a crowd makes a kernel in the crowd, and nothing where it is
};

/// How PathSpaceGuide makes kernels of paths.
struct PathSpaceSettings {
  int neighbors = 10;  ///< paths that shape a kernel, the guide path among them
  KernelCenter center = KernelCenter::guide_path;
  double least_deviation = 1e-4;  ///< of a kernel along the floor and along the light [scene units]
  bool accumulate = false;  ///< keeps the guide paths of all iterations, not of the last one only
};

/// Standard normal, by the Box-Muller transform of two numbers.
double normal_number(RandomStream& random);

/// Guiding by complete paths, in the manner of Reibold et al. 2018, "Selective Guided Sampling with
/// Complete Light Transport Paths", reduced to this scene, where a path is a pair: where it starts
/// on the floor (x0) and where it meets the light (x1). Every path that found light is a guide; it
/// becomes a Gaussian over such pairs, as wide as the covariance of its nearest neighbors about
/// the Gaussian's center, and weighted by the path's value. At a point of the floor a Gaussian is
/// chosen in proportion to its weight times its density there, and x1 is drawn from it given x0.
/// (The paper keeps only guides that cause variance and truncates the Gaussians; here the guides
/// are few, and the mixture with uniform sampling bounds the estimator.)
class PathSpaceGuide final : public Guide {
 public:
  explicit PathSpaceGuide(double light_height, const PathSpaceSettings& settings = {})
      : light_height_(light_height), settings_(settings) {}

  /// Knows nothing as long as there are fewer paths than a kernel needs.
  void learn(std::span<const Path> paths, int iteration) override;
  std::unique_ptr<DirectionDensity> at(double x) const override;

  /// A path as a pair of points, and its weight.
  struct GuidePath {
    double x0 = 0, x1 = 0;
    double weight = 0;
  };
  const std::vector<GuidePath>& guide_paths() const { return paths_; }

 private:
  /// A Gaussian over pairs as a marginal and a conditional: x0 is normal, and given x0 so is x1,
  /// about mean1 + slope (x0 - mean0).
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
