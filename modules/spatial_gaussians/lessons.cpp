#include "lessons.h"

#include "model.h"

namespace pharos::spatial_gaussians {
namespace {

/// Returns the diagonal of the scene, or one if the scene has no extent.
double size_of(const Bounds3& region) {
  return region.diagonal() > 0 ? region.diagonal() : 1;
}

}  // namespace

SpatialGaussiansLessons::SpatialGaussiansLessons(const SpatialGaussiansSettings& settings,
                                                 const LearningContext& context)
    : settings_(settings),
      rule_{settings.least_pdf,
            settings.environment_distance * static_cast<float>(size_of(context.region))},
      scene_size_(size_of(context.region)),
      seed_(context.seed) {}

std::shared_ptr<const GuidingModel> SpatialGaussiansLessons::model(
    const KdTreeCells<Sample, CellMixture>& cells) const {
  std::vector<SpatialGaussiansModel::Cell> contents;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    contents.push_back({cells[i].components(), static_cast<float>(cells[i].samples())});
  }
  return std::make_shared<SpatialGaussiansModel>(cells.tree(), contents);
}

}  // namespace pharos::spatial_gaussians
