#include "guider.h"

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
    return propose_direction(*direction);
  }

  float density(const ResolvedVertex& vertex) const override {
    return static_cast<float>(density_.directional_density(origin_, vertex.direction));
  }

 private:
  const FocalDensity& density_;
  Point3 origin_;
};

}  // namespace

const GuidingDistribution* FocalGuider::query(const FocalModel& model, const GuidingQuery& query,
                                              Arena& arena) const {
  return arena.make<FocalDistribution>(model.focal_density(), query.current.position);
}

}  // namespace pharos::focal
