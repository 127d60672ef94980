#include "guider.h"

namespace pharos::focal {
namespace {

/// Returns three numbers in [0, 1) of 48 bits. Their first half comes from the dimensions that
/// samplers distribute best.
Double3 numbers(const VertexStream& stream) {
  const auto draw = [&](std::uint16_t half) -> Double3 {
    const Vec2 u = stream.get_2d(Purpose::guide_direction, half);
    return {u.x, u.y, stream.get_1d(Purpose::guide_distance, half)};
  };
  Double3 result = draw(0);
  const Double3 rest = draw(1);
  for (int axis = 0; axis < 3; ++axis) result[axis] += 0x1p-24 * rest[axis];
  return result;
}

class FocalDistribution final : public GuidingDistribution {
 public:
  FocalDistribution(const FocalDensity& density, Point3 origin)
      : density_(density), origin_(origin) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const std::optional<Vec3> direction =
        density_.sample_direction(origin_, stream.get_1d(Purpose::guide_choice), numbers(stream));
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
  return arena.make<FocalDistribution>(model.focal_density(query.current.position),
                                       query.current.position);
}

}  // namespace pharos::focal
