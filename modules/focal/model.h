#pragma once

#include <pharos/guiding/contract/model.h>

#include "focal_density.h"

namespace pharos::focal {

/// A learned density of focal points.
class FocalModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "focal";

  FocalModel() = default;
  explicit FocalModel(FocalDensity density) : density_(std::move(density)) {}

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  double density(Point3 point, const Vec3* direction) const override {
    return direction == nullptr ? density_.at(point)
                                : density_.directional_density(point, *direction);
  }

  const FocalDensity& focal_density() const { return density_; }

 private:
  FocalDensity density_;
};

}  // namespace pharos::focal
