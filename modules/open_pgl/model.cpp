#include "model.h"

#include <fmt/format.h>

namespace pharos::open_pgl {

OpenPglModel::OpenPglModel(std::string bytes)
    : bytes_(std::move(bytes)), field_(field_of(bytes_)) {}

const Workplace* OpenPglModel::at(const Query& query) const {
  if (field_ == nullptr) return nullptr;
  std::unique_ptr<Workplace>& workplace = workplaces_.local();
  if (workplace == nullptr) workplace = std::make_unique<Workplace>(*field_);
  return workplace->take(query) ? workplace.get() : nullptr;
}

ModelInfo OpenPglModel::info() const {
  ModelInfo info{.name = std::string(kName), .version = 2, .bytes = bytes_.size()};
  if (field_ == nullptr) return info;
  const pgl_box3f box = field_->GetSceneBounds();
  info.bounds = {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
  info.facts = {{"updates", fmt::format("{}", field_->GetIteration())}};
  return info;
}

void OpenPglModel::archive(Archive& archive) {
  archive_bytes(archive, bytes_);
  if (archive.loads()) field_ = field_of(bytes_);
}

double OpenPglModel::density(Point3 point, const Vec3* direction) const {
  if (field_ == nullptr) return 0;
  Workplace workplace(*field_);
  if (!workplace.take(Query{.position = point})) return 0;
  return direction == nullptr ? 1 : workplace.pdf(*direction);
}

}  // namespace pharos::open_pgl
