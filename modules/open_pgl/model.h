#pragma once

#include <memory>
#include <string>

#include <pharos/guiding/contract/model.h>

#include "pgl_field.h"

namespace pharos::open_pgl {

/// A field of Open PGL that changes no more.
class OpenPglModel final : public GuidingModel {
 public:
  /// The kind of model. A learner and a guider that both name it go together.
  static constexpr const char* kName = "open_pgl_field";
  static constexpr std::uint32_t kVersion = 1;

  /// `bytes` as bytes_of() makes them.
  explicit OpenPglModel(std::string bytes);
  /// What save() wrote. Throws InputError when it is something else or damaged.
  explicit OpenPglModel(std::istream& in);

  const openpgl::cpp::Field& field() const { return *field_; }

  std::string name() const override { return kName; }
  std::uint32_t version() const override { return kVersion; }
  /// As it is stored; in memory the library's cells are about as large.
  std::size_t size_bytes() const override { return bytes_.size(); }
  void save(std::ostream& out) const override;
  Bounds3 bounds() const override;
  std::vector<ModelFact> facts() const override;
  /// 1 where the field knows something: the library tells no more.
  double density(Point3 point) const override;
  double density(Point3 point, Vec3 direction) const override;

 private:
  std::string bytes_;
  std::unique_ptr<openpgl::cpp::Field> field_;
};

}  // namespace pharos::open_pgl
