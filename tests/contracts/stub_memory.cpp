// Stub (h): a method that remembers its path. It counts the vertices at which it was queried. Its
// directions lie in a lobe about the direction to the previous vertex, which gets narrower with
// every vertex. It samples any model that estimates radiance, such as the model of the learner
// `uniform`, and ignores the estimate.

#include <algorithm>
#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/core/frame.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/radiance_estimate.h>

#include "stubs.h"

namespace pharos::stubs {
namespace {

/// The memory that is left for the next vertex.
struct Memory {
  std::uint32_t vertices = 0;  ///< number of vertices at which the guide was queried
};

/// Samples directions with the density (n + 1) / (2 pi) cos^n about an axis.
class LobeDistribution final : public GuidingDistribution {
 public:
  LobeDistribution(Vec3 axis, std::uint32_t exponent)
      : frame_(Frame::from_normal(axis)), exponent_(static_cast<float>(exponent)) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const Vec2 u = stream.get_2d(Purpose::guide_direction);
    const float z = std::pow(1 - u.x, 1 / (exponent_ + 1));
    const float r = std::sqrt(std::max(1 - z * z, 0.0f)), phi = 2 * kPi * u.y;
    return Proposal{.direction = frame_.to_world({r * std::cos(phi), r * std::sin(phi), z})};
  }
  float density(const ResolvedVertex& vertex) const override {
    const float cosine = dot(vertex.direction, frame_.n);
    return cosine > 0 ? (exponent_ + 1) / (2 * kPi) * std::pow(cosine, exponent_) : 0.0f;
  }

 private:
  Frame frame_;
  float exponent_;
};

class MemoryGuider final : public GuiderOf<RadianceEstimate> {
 public:
  using Settings = NoSettings;
  explicit MemoryGuider(Settings) {}
  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const RadianceEstimate&, const GuidingQuery& query,
                                   Arena& arena) const override {
    return arena.make<LobeDistribution>(query.towards_previous, vertices_before(query));
  }

 private:
  /// Returns the number of earlier vertices of the path that the guide remembers. Paths that are
  /// made from both ends (bounce 0) must have the same densities with and without memory.
  static std::uint32_t vertices_before(const GuidingQuery& query) {
    if (query.memory == nullptr || query.bounce == 0) return 0;
    const auto* memory = query.memory->get<Memory>();
    const std::uint32_t vertices = memory == nullptr ? 0 : memory->vertices;
    query.memory->leave<Memory>(Memory{vertices + 1});
    return vertices;
  }
};

}  // namespace

void register_memory(Registry& registry) {
  registry.add<MemoryGuider>("stub_memory", "Lobes that narrow along the path");
}

}  // namespace pharos::stubs
