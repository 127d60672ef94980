#include "model.h"

#include <fmt/format.h>

#include <pharos/core/warp.h>

#include "seen_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

class LobeRadiance final : public RadianceAround {
 public:
  explicit LobeRadiance(const SeenLobes& lobes) : lobes_(lobes) {}
  float relative(Vec3 direction) const override {
    return lobes_.density(direction) / warp::sphere_pdf();
  }

 private:
  const SeenLobes& lobes_;
};

}  // namespace

ParallaxAwareMixturesModel::ParallaxAwareMixturesModel(KdTree tree, const std::vector<Cell>& cells)
    : tree_(std::move(tree)), places_{{}} {
  samples_.clear();
  for (const Cell& cell : cells) add(cell);
}

void ParallaxAwareMixturesModel::add(const Cell& cell) {
  groups_.insert(groups_.end(), cell.groups.begin(), cell.groups.end());
  places_.back().pivot = cell.pivot;
  places_.push_back({{}, static_cast<std::uint32_t>(groups_.size())});
  samples_.push_back(cell.samples);
}

void ParallaxAwareMixturesModel::archive(Archive& archive) {
  archive(tree_);
  if (archive.loads()) *this = ParallaxAwareMixturesModel(std::move(tree_), {});
  for (std::uint32_t i = 0; i < tree_.cell_count(); ++i) {
    Cell cell;
    if (!archive.loads()) {
      const std::span<const LobeGroup> own = groups(i);
      cell = {places_[i].pivot, {own.begin(), own.end()}, samples_[i]};
    }
    archive(cell);
    archive.expect(cell.samples >= 0 && is_sound(cell.groups),
                   "the model of von Mises-Fisher mixtures");
    if (archive.loads()) add(cell);
  }
}

ModelInfo ParallaxAwareMixturesModel::info() const {
  const auto known = std::count_if(samples_.begin(), samples_.end(), [](float s) { return s > 0; });
  std::size_t lobes = 0;
  for (const LobeGroup& group : groups_) {
    for (std::size_t i = 0; i < kLanes; ++i) lobes += group.weight[i] > 0 ? 1 : 0;
  }
  return {.name = std::string(kName),
          .version = 2,
          .bytes = tree_.size_bytes() + groups_.size() * sizeof(LobeGroup) +
                   samples_.size() * (sizeof(CellPlace) + sizeof(float) + sizeof(std::uint32_t)),
          .regions = tree_.cell_count(),
          .facts = {{"cells", fmt::format("{}, {} levels of planes, {} know something",
                                          tree_.cell_count(), tree_.depth(), known)},
                    {"lobes", fmt::format("{}", lobes)}}};
}

double ParallaxAwareMixturesModel::density(Point3 point, const Vec3* direction) const {
  const std::uint32_t cell = tree_.cell_at(point);
  if (direction == nullptr) return samples_[cell];
  Arena arena;
  const SeenLobes* seen = SeenLobes::make(groups(cell), offset(cell, point), {}, arena);
  return seen == nullptr ? 0 : seen->density(*direction);
}

// The lobes are fitted to samples that are weighted by radiance over density, without the BSDF.
const RadianceAround* ParallaxAwareMixturesModel::radiance_around(const GuidingQuery& query,
                                                                  Arena& arena) const {
  const std::span<const LobeGroup> lobes = groups(query.region);
  if (lobes.empty()) return nullptr;
  const SeenLobes* seen =
      SeenLobes::make(lobes, offset(query.region, query.current.position), {}, arena);
  return seen == nullptr ? nullptr : arena.make<LobeRadiance>(*seen);
}

}  // namespace pharos::parallax_aware_mixtures
