#pragma once

#include <algorithm>

#include <pharos/guiding/contract/model.h>

#include "focal_density.h"

namespace pharos::focal {

/// A learned density of focal points.
class FocalModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "focal";

  FocalModel() = default;
  /// `segments` is the number of segments from which the density was learned.
  FocalModel(FocalDensity density, float segments)
      : density_(std::move(density)), segments_(segments) {}

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  /// The density is the same everywhere, so all segments are evidence.
  Place place(const GuidingVertex&) const override {
    return {.evidence = std::max(segments_, 1.0f)};
  }
  double density(Point3 point, const Vec3* direction) const override {
    return direction == nullptr ? density_.at(point)
                                : density_.directional_density(point, *direction);
  }

  const FocalDensity& focal_density() const { return density_; }

 private:
  FocalDensity density_;
  float segments_ = 0;
};

}  // namespace pharos::focal
