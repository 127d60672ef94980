#include "guider.h"

#include "seen_lobes.h"

namespace pharos::parallax_aware_mixtures {
namespace {

class ParallaxAwareMixturesDistribution final : public GuidingDistribution {
 public:
  explicit ParallaxAwareMixturesDistribution(const SeenLobes& lobes) : lobes_(lobes) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return propose_direction(lobes_.sample(stream.get_1d(Purpose::guide_choice),
                                           stream.get_2d(Purpose::guide_direction)));
  }
  float density(const ResolvedVertex& vertex) const override {
    return lobes_.density(vertex.direction);
  }

 private:
  const SeenLobes& lobes_;
};

}  // namespace

void ParallaxAwareMixturesGuiderSettings::describe(Schema<ParallaxAwareMixturesGuiderSettings>& s) {
  s.field("product", &ParallaxAwareMixturesGuiderSettings::product,
          "Factor that mixtures are multiplied by at a vertex: nothing, a lobe in place of the "
          "cosine, or lobes fitted to the BSDF or phase function");
  describe_scattering_fit(s);
  s.example("{ product: none }");
  s.example("{ product: bsdf }");
}

const GuidingDistribution* ParallaxAwareMixturesGuider::query(
    const ParallaxAwareMixturesModel& model, const GuidingQuery& query, Arena& arena) const {
  const std::span<const LobeGroup> groups = model.groups(query.region);
  if (groups.empty()) return nullptr;
  const ScatteringLobes factors = factors_at(query);
  const SeenLobes* seen =
      SeenLobes::make(groups, model.offset(query.region, query.current.position),
                      {factors.lobes.data(), factors.count}, arena);
  return seen == nullptr ? nullptr : arena.make<ParallaxAwareMixturesDistribution>(*seen);
}

/// Returns the lobes that the mixture is multiplied by.
ScatteringLobes ParallaxAwareMixturesGuider::factors_at(const GuidingQuery& query) const {
  if (settings_.product == ProductFactor::bsdf) {
    return fit_scattering(*query.scattering, settings_);
  }
  if (settings_.product == ProductFactor::none || !is_opaque_surface(query)) return {};
  return {.lobes = {ScatteringLobe{normal_towards_path(query), kCosineKappa}}, .count = 1};
}

}  // namespace pharos::parallax_aware_mixtures
