#include "model.h"

#include <fmt/format.h>

#include <pharos/core/binary_stream.h>

#include "query.h"

namespace pharos::open_pgl {

OpenPglModel::OpenPglModel(std::string bytes)
    : bytes_(std::move(bytes)), field_(field_of(bytes_)) {}

OpenPglModel::OpenPglModel(std::istream& in) {
  expect_heading(in, kName, kVersion);
  bytes_ = load_bytes(in);
  field_ = field_of(bytes_);
}

void OpenPglModel::save(std::ostream& out) const {
  save_heading(out, kName, kVersion);
  save_bytes(bytes_, out);
}

Bounds3 OpenPglModel::bounds() const {
  const pgl_box3f box = field_->GetSceneBounds();
  return {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
}

std::vector<ModelFact> OpenPglModel::facts() const {
  return {{"updates", fmt::format("{}", field_->GetIteration())}};
}

double OpenPglModel::density(Point3 point) const {
  Workplace workplace(*field_);
  return workplace.take(Query{.position = point}) ? 1 : 0;
}

double OpenPglModel::density(Point3 point, Vec3 direction) const {
  Workplace workplace(*field_);
  return workplace.take(Query{.position = point}) ? workplace.pdf(direction) : 0;
}

}  // namespace pharos::open_pgl
