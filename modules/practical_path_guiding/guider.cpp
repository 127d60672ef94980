#include "guider.h"

#include <pharos/core/warp.h>

namespace pharos::practical_path_guiding {
namespace {

class PracticalPathGuidingDistribution final : public GuidingDistribution {
 public:
  explicit PracticalPathGuidingDistribution(std::span<const QuadNode> nodes) : density_(nodes) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const Vec2 p = density_.sample(stream.get_2d(Purpose::guide_direction));
    return propose_direction(warp::sphere_from_square(p));
  }
  float density(const ResolvedVertex& vertex) const override {
    return density_.at(warp::square_from_sphere(vertex.direction)) * warp::sphere_pdf();
  }

 private:
  QuadDensity density_;
};

}  // namespace

const GuidingDistribution* PracticalPathGuidingGuider::query(const PracticalPathGuidingModel& model,
                                                             const GuidingQuery& query,
                                                             Arena& arena) const {
  const std::span<const QuadNode> nodes = model.nodes(query.region);
  return nodes.empty() ? nullptr : arena.make<PracticalPathGuidingDistribution>(nodes);
}

}  // namespace pharos::practical_path_guiding
