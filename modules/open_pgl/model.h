#pragma once

#include <memory>
#include <string>

#include <tbb/enumerable_thread_specific.h>

#include <pharos/guiding/contract/model.h>

#include "query.h"

namespace pharos::open_pgl {

/// A field of Open PGL that changes no more.
class OpenPglModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "open_pgl";

  OpenPglModel() = default;
  /// `bytes` as bytes_of() makes them.
  explicit OpenPglModel(std::string bytes);

  /// This thread's workplace, which has taken the query; null: the field knows nothing there.
  const Workplace* at(const Query& query) const;

  /// The size is that of the stored field; in memory the library's cells are about as large.
  ModelInfo info() const override;
  void archive(Archive& archive) override;
  /// At a point alone 1 if the field knows something there: the library tells no more.
  double density(Point3 point, const Vec3* direction) const override;

 private:
  std::string bytes_;
  std::unique_ptr<openpgl::cpp::Field> field_;
  mutable tbb::enumerable_thread_specific<std::unique_ptr<Workplace>> workplaces_;
};

}  // namespace pharos::open_pgl
