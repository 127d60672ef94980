#include "guider.h"

namespace pharos::spatial_gaussians {
namespace {

class SeenDistribution final : public GuidingDistribution {
 public:
  explicit SeenDistribution(const SeenMixture& mixture) : mixture_(mixture) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const std::optional<Vec3> direction = mixture_.sample(stream.get_1d(Purpose::guide_choice),
                                                          stream.get_2d(Purpose::guide_direction),
                                                          stream.get_1d(Purpose::guide_distance));
    if (!direction) return std::nullopt;
    return propose_direction(*direction);
  }
  float density(const ResolvedVertex& vertex) const override {
    return mixture_.density(vertex.direction);
  }

 private:
  const SeenMixture& mixture_;
};

/// Returns the rule for the cosine at a vertex. In media there is no normal, so weights stay
/// unchanged.
CosineRule rule_at(const GuidingQuery& query, const SeenSettings& settings) {
  CosineRule rule{.least = settings.least_cosine};
  if (!settings.reweight || query.current.kind != VertexKind::surface) return rule;
  const Vec3 n = query.current.shading_normal;
  rule.normal = dot(n, query.towards_previous) < 0 ? -n : n;
  rule.both_sides = contains(query.scattering->events(), Event::smooth_transmit);
  return rule;
}

}  // namespace

void SeenSettings::describe(Schema<SeenSettings>& s) {
  s.field("reweight", &SeenSettings::reweight,
          "Multiply the weight of each component by the cosine between the normal and the "
          "direction to its mean");
  s.field("least_cosine", &SeenSettings::least_cosine,
          "Lower bound of this cosine, so that components that are partly visible keep some weight")
      .at_least(1e-6)
      .at_most(1);
}

const GuidingDistribution* MixtureGuider::query(const SpatialMixture& model,
                                                const GuidingQuery& query, Arena& arena) const {
  const std::span<const SpatialGaussian> components = model.mixture_at(query, arena);
  if (components.empty()) return nullptr;
  const SeenMixture* seen =
      SeenMixture::make(components, query.current.position, rule_at(query, settings_), technique_,
                        arena, model.whitened_at(query));
  return seen == nullptr ? nullptr : arena.make<SeenDistribution>(*seen);
}

}  // namespace pharos::spatial_gaussians
