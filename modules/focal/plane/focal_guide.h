#pragma once

#include "guide.h"
#include "quadtree.h"
#include "scene.h"

namespace pharos::focal::plane {

/// How FocalGuide learns.
struct FocalSettings {
  Quadtree::SplitRule split;
  int narrowing_from = 3;        ///< training iteration, counted from 0
  double guided_fraction = 0.5;  ///< with which the paths it learns from are drawn, but the first
};

/// Focal guiding (Rath et al. 2023) in the plane: one density over space, shared by the whole
/// floor, whose points are aimed at. There is no density of diverging points: their lines would
/// have to meet behind the floor, where nothing is. Each iteration fits anew.
class FocalGuide final : public Guide {
 public:
  /// Learns over the box about floor, obstacle and light.
  explicit FocalGuide(const GapScene& scene, const FocalSettings& settings = {});

  /// Splats each path's value onto the leaves along its line: times the length in the leaf (eq.
  /// 10), or from `narrowing_from` on times the leaf's share of the density with which the
  /// direction was drawn (iterative narrowing with MIS compensation, eq. 11 and 14). A path is a
  /// single segment from the floor to the light, and these bound the region: its line and the
  /// segment are the same.
  void learn(std::span<const Path> paths, int iteration) override;
  std::unique_ptr<DirectionDensity> at(double x) const override;

  const Quadtree& tree() const { return tree_; }

 private:
  FocalSettings settings_;
  Quadtree tree_;
};

}  // namespace pharos::focal::plane
