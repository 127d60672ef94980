#pragma once

#include "guide.h"
#include "quadtree.h"
#include "scene.h"

namespace pharos::focal::plane {

/// The parameters of FocalGuide.
struct FocalSettings {
  Quadtree::SplitRule split;
  int narrowing_from = 3;        ///< first training iteration with narrowing, counted from 0
  double guided_fraction = 0.5;  ///< of the training paths, except in the first iteration
};

/// Focal guiding (Rath et al. 2023) in the plane: the whole floor shares one density over space and
/// samples directions toward its points. There is no density of diverging points, because lines
/// would have to meet behind the floor, and there is nothing behind the floor. Each iteration fits
/// a new density.
class FocalGuide final : public Guide {
 public:
  /// Learns over the box that contains floor, obstacle and light.
  explicit FocalGuide(const GapScene& scene, const FocalSettings& settings = {});

  /// Splats each path's value onto the leaves along its line. Before `narrowing_from`, the weight
  /// is the length within the leaf (eq. 10). From `narrowing_from` on, it is the leaf's share of
  /// the density with which the direction was sampled (iterative narrowing with MIS compensation,
  /// eq. 11 and 14). A path is a single segment from the floor to the light, and floor and light
  /// bound the region, so the line and the segment are the same.
  void learn(std::span<const Path> paths, int iteration) override;
  std::unique_ptr<DirectionDensity> at(double x) const override;

  const Quadtree& tree() const { return tree_; }

 private:
  FocalSettings settings_;
  Quadtree tree_;
};

}  // namespace pharos::focal::plane
