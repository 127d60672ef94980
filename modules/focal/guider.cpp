#include "guider.h"

#include "model.h"

namespace pharos::focal {
namespace {

class FocalDistribution final : public GuidingDistribution {
 public:
  FocalDistribution(const FocalDensity& density, Point3 origin)
      : density_(density), origin_(origin) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const std::optional<Vec3> direction = density_.sample_direction(
        origin_, stream.get_1d(Purpose::guide_choice), stream.get_2d(Purpose::guide_direction),
        stream.get_1d(Purpose::guide_distance));
    if (!direction) return std::nullopt;
    return Proposal{.direction = *direction};
  }

  Density density(const ResolvedVertex& vertex) const override {
    return {static_cast<float>(density_.directional_density(origin_, vertex.direction)),
            Measure::solid_angle};
  }

 private:
  const FocalDensity& density_;
  Point3 origin_;
};

class BoundFocalGuider final : public BoundGuider {
 public:
  explicit BoundFocalGuider(std::shared_ptr<const FocalModel> model) : model_(std::move(model)) {}

  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const override {
    if (query.scattering.purely_discrete()) return nullptr;
    return arena.make<FocalDistribution>(model_->focal_density(), query.current.position);
  }

 private:
  std::shared_ptr<const FocalModel> model_;
};

}  // namespace

GuiderTraits FocalGuider::traits() const {
  return {.model = kFocalModel};
}

std::unique_ptr<const BoundGuider> FocalGuider::bind(
    std::shared_ptr<const GuidingModel> model) const {
  return std::make_unique<BoundFocalGuider>(bind_model<FocalModel>(model, *this));
}

}  // namespace pharos::focal
