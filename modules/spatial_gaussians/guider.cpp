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
FactorRule cosine_rule(const GuidingQuery& query, float least) {
  FactorRule rule{.least = least};
  if (query.current.kind != VertexKind::surface) return rule;
  rule.normal = normal_towards_path(query);
  rule.both_sides = contains(query.scattering->events(), Event::smooth_transmit);
  return rule;
}

}  // namespace

void SeenSettings::describe(Schema<SeenSettings>& s) {
  s.field("product", &SeenSettings::product,
          "Factor by which the weight of each component is multiplied: nothing, the cosine between "
          "the normal and the direction to its mean, or its integral over lobes that are fitted to "
          "the BSDF or phase function");
  s.field(
       "least_factor", &SeenSettings::least_factor,
       "Lower bound of the cosine, or of the integral relative to scattering that is the same in "
       "all directions, so that components that are partly visible keep some weight")
      .at_least(1e-6)
      .at_most(1);
  describe_scattering_fit(s);
  s.example("{ product: none }");
  s.example("{ product: bsdf }");
}

const GuidingDistribution* MixtureGuider::query(const SpatialMixture& model,
                                                const GuidingQuery& query, Arena& arena) const {
  const std::span<const SpatialGaussian> components = model.mixture_at(query, arena);
  if (components.empty()) return nullptr;
  FactorRule rule{.least = settings_.least_factor};
  ScatteringLobes lobes;
  if (settings_.product == ProductFactor::cosine) {
    rule = cosine_rule(query, settings_.least_factor);
  } else if (settings_.product == ProductFactor::bsdf) {
    lobes = fit_scattering(*query.scattering, settings_);
    rule.lobes = {lobes.lobes.data(), lobes.count};
  }
  const SeenMixture* seen = SeenMixture::make(components, query.current.position, rule, technique_,
                                              arena, model.whitened_at(query));
  return seen == nullptr ? nullptr : arena.make<SeenDistribution>(*seen);
}

}  // namespace pharos::spatial_gaussians
