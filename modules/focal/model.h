#pragma once

#include <algorithm>

#include <pharos/guiding/contract/model.h>

#include "local_density.h"

namespace pharos::focal {

/// A learned density of focal points, one for the whole scene or one for each cell of space.
class FocalModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "focal";

  FocalModel() = default;
  /// `segments` is the number of segments from which the density was learned. `local` has the
  /// densities for the cells of space of a grid with `per_axis` cells along each axis, or none.
  FocalModel(FocalDensity density, float segments, std::vector<FocalDensity> local = {},
             int per_axis = 1);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  /// The density is the same everywhere, so all segments are evidence.
  Place place(const GuidingVertex&) const override {
    return {.evidence = std::max(segments_, 1.0f)};
  }
  double density(Point3 point, const Vec3* direction) const override {
    const FocalDensity& here = focal_density(point);
    return direction == nullptr ? here.at(point) : here.directional_density(point, *direction);
  }

  /// Returns the density of the whole scene.
  const FocalDensity& focal_density() const { return density_; }
  /// Returns the density for directions from a point.
  const FocalDensity& focal_density(Point3 from) const {
    return local_.empty() ? density_ : local_[grid_.at(from)];
  }

 private:
  FocalDensity density_;
  float segments_ = 0;
  int per_axis_ = 1;
  std::vector<FocalDensity> local_;  ///< by cell of `grid_`; empty: `density_` everywhere
  CellGrid grid_;
};

}  // namespace pharos::focal
