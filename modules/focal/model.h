#pragma once

#include <iosfwd>

#include <pharos/guiding/contract/model.h>

#include "focal_density.h"

namespace pharos::focal {

/// Name of the model for traits and files.
inline constexpr const char* kFocalModel = "focal_octree";

/// A learned density of focal points.
class FocalModel final : public GuidingModel {
 public:
  explicit FocalModel(FocalDensity density) : density_(std::move(density)) {}
  /// What save() wrote. Throws InputError when it is something else or damaged.
  explicit FocalModel(std::istream& in);

  std::string name() const override { return kFocalModel; }
  std::uint32_t version() const override { return kVersion; }
  std::size_t size_bytes() const override { return density_.size_bytes(); }
  void save(std::ostream& out) const override;

  Bounds3 bounds() const override;
  std::vector<ModelFact> facts() const override;
  double density(Point3 point) const override { return density_.at(point); }
  double density(Point3 point, Vec3 direction) const override {
    return density_.directional_density(point, direction);
  }

  const FocalDensity& focal_density() const { return density_; }

 private:
  static constexpr std::uint32_t kVersion = 1;

  FocalDensity density_;
};

}  // namespace pharos::focal
