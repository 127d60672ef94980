#pragma once

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/radiance_estimate.h>

namespace pharos {

/// A single number: the mean radiance that arrived along the steps of paths. It also serves as an
/// estimate of incident radiance.
class UniformModel final : public GuidingModel, public RadianceEstimate {
 public:
  static constexpr std::string_view kName = "uniform";

  UniformModel() = default;
  /// `radiance` >= 0, in the unit of the scene's emitters.
  explicit UniformModel(double radiance) : radiance_(radiance) {}

  /// `version` must be raised whenever archive() changes.
  ModelInfo info() const override {
    return {.name = std::string(kName), .version = 1, .bytes = sizeof *this};
  }
  void archive(Archive& archive) override {
    archive(radiance_);
    archive.expect(radiance_ >= 0, "the radiance");
  }
  /// Returns evidence 0 as long as no path has found light.
  Place place(const GuidingVertex&) const override {
    return {.evidence = radiance_ > 0 ? 1.0f : 0.0f};
  }
  double density(Point3, const Vec3*) const override { return radiance_; }

  RadianceTraits radiance_traits() const override { return {.incident = true, .around = true}; }
  float incident_radiance(Point3, Vec3) const override { return static_cast<float>(radiance_); }
  const RadianceAround* radiance_around(const GuidingQuery&, Arena& arena) const override {
    return radiance_ > 0 ? arena.make<SameFromEverywhere>() : nullptr;
  }

 private:
  class SameFromEverywhere final : public RadianceAround {
   public:
    float relative(Vec3) const override { return 1; }
  };

  double radiance_ = 0;
};

}  // namespace pharos
