#pragma once

#include <pharos/guiding/contract/model.h>

namespace pharos {

/// One number: the mean radiance that paths met.
class UniformModel final : public GuidingModel {
 public:
  /// The kind of model. A learner and a guider that both name it go together.
  static constexpr const char* kName = "uniform";
  /// To be raised whenever save() writes something else.
  static constexpr std::uint32_t kVersion = 1;

  /// `radiance` >= 0, in the unit of the scene's emitters.
  explicit UniformModel(double radiance) : radiance_(radiance) {}

  std::string name() const override { return kName; }
  std::uint32_t version() const override { return kVersion; }
  std::size_t size_bytes() const override { return sizeof *this; }
  void save(std::ostream& out) const override;

  double density(Point3) const override { return radiance_; }
  double density(Point3, Vec3) const override { return radiance_; }

 private:
  double radiance_;
};

}  // namespace pharos
