#pragma once

#include <memory>
#include <string>

#include <tbb/enumerable_thread_specific.h>

#include <pharos/guiding/contract/model.h>

#include "query.h"

namespace pharos::open_pgl {

/// A field of Open PGL that no longer changes.
class OpenPglModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "open_pgl";

  OpenPglModel() = default;
  /// Makes the field from `bytes`, as bytes_of() returns them.
  explicit OpenPglModel(std::string bytes);

  /// Returns this thread's workplace with the answer to the query, or null if the field knows
  /// nothing there.
  const Workplace* at(const Query& query) const;

  /// ModelInfo::bytes is the size of the stored field. The library needs about as much memory for
  /// its cells.
  ModelInfo info() const override;
  void archive(Archive& archive) override;
  /// If `direction` is null, returns 1 if the field knows something at the point, otherwise 0,
  /// because the library has no density of points.
  double density(Point3 point, const Vec3* direction) const override;

 private:
  std::string bytes_;
  std::unique_ptr<openpgl::cpp::Field> field_;
  mutable tbb::enumerable_thread_specific<std::unique_ptr<Workplace>> workplaces_;
};

}  // namespace pharos::open_pgl
