#include "guider.h"

#include <pharos/core/warp.h>

#include "model.h"

namespace pharos::practical_path_guiding {
namespace {

class PracticalPathGuidingDistribution final : public GuidingDistribution {
 public:
  explicit PracticalPathGuidingDistribution(const PracticalPathGuidingModel::View& view)
      : density_(view.nodes), region_(view.cell) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const Vec2 p = density_.sample(stream.get_2d(Purpose::guide_direction));
    return Proposal{.direction = warp::sphere_from_square(p)};
  }
  Density density(const ResolvedVertex& vertex) const override {
    const float relative = density_.at(warp::square_from_sphere(vertex.direction));
    return {relative * warp::sphere_pdf(), Measure::solid_angle};
  }
  std::uint32_t region() const override { return region_; }

 private:
  QuadDensity density_;
  std::uint32_t region_;
};

class BoundSdTreeGuider final : public BoundGuider {
 public:
  explicit BoundSdTreeGuider(std::shared_ptr<const PracticalPathGuidingModel> tree)
      : tree_(std::move(tree)) {}

  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const override {
    if (query.scattering.purely_discrete()) return nullptr;
    const PracticalPathGuidingModel::View view = tree_->at(query.current.position);
    return view.nodes.empty() ? nullptr : arena.make<PracticalPathGuidingDistribution>(view);
  }

 private:
  std::shared_ptr<const PracticalPathGuidingModel> tree_;
};

}  // namespace

GuiderTraits PracticalPathGuidingGuider::traits() const {
  return {.model = PracticalPathGuidingModel::kName};
}

std::unique_ptr<const BoundGuider> PracticalPathGuidingGuider::bind(
    std::shared_ptr<const GuidingModel> model) const {
  return std::make_unique<BoundSdTreeGuider>(bind_model<PracticalPathGuidingModel>(model, *this));
}

}  // namespace pharos::practical_path_guiding
