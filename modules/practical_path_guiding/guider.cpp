#include "guider.h"

#include <algorithm>

#include <pharos/core/warp.h>

namespace pharos::practical_path_guiding {
namespace {

/// Number of nodes that are fetched ahead: the upper three levels.
constexpr std::size_t kPrefetched = 21;
/// Number of nodes in a cache line.
constexpr std::size_t kInLine = 64 / sizeof(QuadNode);

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
  // The vertex samples a light first; meanwhile the upper levels of the quadtree can arrive.
  for (std::size_t i = 0; i < std::min<std::size_t>(nodes.size(), kPrefetched); i += kInLine) {
    __builtin_prefetch(&nodes[i]);
  }
  return nodes.empty() ? nullptr : arena.make<PracticalPathGuidingDistribution>(nodes);
}

}  // namespace pharos::practical_path_guiding
