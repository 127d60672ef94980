#include "focal_guide.h"

#include <cmath>

namespace pharos::focal::plane {
namespace {

Cell region_of(const GapScene& scene) {
  return {{-scene.half_width(), 0}, {2 * scene.half_width(), scene.light_height}};
}

/// The density of directions from a point of the floor toward points of the tree.
class TowardsTree final : public DirectionDensity {
 public:
  TowardsTree(double x, const Quadtree& tree) : origin_{x, 0}, tree_(tree) {}

  double sample(RandomStream& random) const override {
    const Point2 target = tree_.sample(random);
    return std::atan2(target.x - origin_.x, target.y);
  }
  double pdf(double angle) const override { return tree_.directional_density(Ray(origin_, angle)); }

 private:
  Point2 origin_;
  const Quadtree& tree_;
};

}  // namespace

FocalGuide::FocalGuide(const GapScene& scene, const FocalSettings& settings)
    : settings_(settings), tree_(region_of(scene), settings.split) {}

void FocalGuide::learn(std::span<const Path> paths, int iteration) {
  Quadtree::Sums sums = tree_.empty_sums();
  const bool narrowing = iteration >= settings_.narrowing_from;
  for (const Path& path : paths) {
    const auto splat = [&](const Quadtree::Child& leaf, const Cell& cell, std::size_t index,
                           const Stretch& stretch) {
      const double weight = narrowing
                                ? settings_.guided_fraction *
                                      Quadtree::directional_term(leaf, cell, stretch) / path.pdf
                                : stretch.end - stretch.begin;
      sums[index] += weight * path.value;
    };
    tree_.traverse(Ray({path.x, 0}, path.angle), splat);
  }
  tree_ = tree_.refined(sums, settings_.split);
}

std::unique_ptr<DirectionDensity> FocalGuide::at(double x) const {
  return std::make_unique<TowardsTree>(x, tree_);
}

}  // namespace pharos::focal::plane
