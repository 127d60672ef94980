#include "model.h"

#include <algorithm>

#include <fmt/format.h>

#include <pharos/core/warp.h>

namespace pharos::practical_path_guiding {
namespace {

class CellRadiance final : public RadianceAround {
 public:
  explicit CellRadiance(std::span<const QuadNode> nodes) : density_(nodes) {}
  float relative(Vec3 direction) const override {
    return density_.at(warp::square_from_sphere(direction));
  }

 private:
  QuadDensity density_;
};

}  // namespace

PracticalPathGuidingModel::PracticalPathGuidingModel(Cells cells, const std::vector<Cell>& learned,
                                                     bool of_radiance)
    : cells_(std::move(cells)), of_radiance_(of_radiance) {
  known_.clear();
  for (const Cell& cell : learned) add(cell);
}

void PracticalPathGuidingModel::add(const Cell& cell) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.insert(nodes_.end(), cell.nodes.begin(), cell.nodes.end());
  known_.push_back({first, static_cast<std::uint32_t>(nodes_.size()), cell.light, cell.records});
}

void PracticalPathGuidingModel::archive(Archive& archive) {
  archive(cells_, of_radiance_);
  const auto expect = [&](bool holds) { archive.expect(holds, "the SD-tree"); };
  if (archive.loads()) *this = PracticalPathGuidingModel(std::move(cells_), {}, of_radiance_);
  for (std::uint32_t i = 0; i < cells_.count(); ++i) {
    Cell cell;
    if (!archive.loads()) {
      const std::span<const QuadNode> own = nodes(i);
      cell = {{own.begin(), own.end()}, known_[i].light, known_[i].records};
    }
    archive(cell);
    expect(is_density(cell.nodes) && cell.light >= 0 && cell.records >= 0);
    if (archive.loads()) add(cell);
  }
}

ModelInfo PracticalPathGuidingModel::info() const {
  std::size_t known = 0, most = 0;
  for (std::uint32_t cell = 0; cell < cells_.count(); ++cell) {
    const std::size_t count = nodes(cell).size();
    known += count > 0 ? 1 : 0;
    most = std::max(most, count);
  }
  return {.name = std::string(kName),
          .version = 4,
          .bytes = cells_.space.size_bytes() + nodes_.size() * sizeof(QuadNode) +
                   known_.size() * sizeof(KnownCell),
          .regions = cells_.count(),
          .facts = {{"cells", fmt::format("{}, {} levels of planes, {} know something",
                                          cells_.count(), cells_.space.depth(), known)},
                    {"directional nodes",
                     fmt::format("{}, {} in one cell at most", nodes_.size(), most)}}};
}

double PracticalPathGuidingModel::density(Point3 point, const Vec3* direction) const {
  if (direction == nullptr) {
    double light = 0;
    const std::uint32_t first = cells_.at(point, std::uint32_t{0});
    for (std::uint32_t i = 0; i < cells_.in_each(); ++i) light += known_[first + i].light;
    return light;
  }
  // Light from a direction arrives on surfaces that face it.
  const std::uint32_t cell = cells_.at(point, *direction);
  if (nodes(cell).empty()) return 0;
  return QuadDensity(nodes(cell)).at(warp::square_from_sphere(*direction)) * warp::sphere_pdf();
}

// The cell's mean of radiance divided by density estimates the integral of radiance over all
// directions.
float PracticalPathGuidingModel::incident_radiance(Point3 point, Vec3 direction) const {
  const float light = known_[cells_.at(point, direction)].light;
  return static_cast<float>(light * density(point, &direction));
}

const RadianceAround* PracticalPathGuidingModel::radiance_around(const GuidingQuery& query,
                                                                 Arena& arena) const {
  const std::span<const QuadNode> of_cell = nodes(query.region);
  return of_cell.empty() ? nullptr : arena.make<CellRadiance>(of_cell);
}

}  // namespace pharos::practical_path_guiding
