#include "guider.h"

namespace pharos::spatial_gaussians {
namespace {

class SeenDistribution final : public GuidingDistribution {
 public:
  SeenDistribution(const SeenMixture& mixture, std::uint32_t region)
      : mixture_(mixture), region_(region) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    const std::optional<Vec3> direction = mixture_.sample(stream.get_1d(Purpose::guide_choice),
                                                          stream.get_2d(Purpose::guide_direction),
                                                          stream.get_1d(Purpose::guide_distance));
    if (!direction) return std::nullopt;
    return Proposal{.direction = *direction};
  }
  Density density(const ResolvedVertex& vertex) const override {
    return {mixture_.density(vertex.direction), Measure::solid_angle};
  }
  std::uint32_t region() const override { return region_; }

 private:
  const SeenMixture& mixture_;
  std::uint32_t region_;
};

class BoundMixtureGuider final : public BoundGuider {
 public:
  BoundMixtureGuider(std::shared_ptr<const SpatialMixture> mixture, const SeenSettings& settings,
                     Technique technique)
      : mixture_(std::move(mixture)), settings_(settings), technique_(technique) {}

  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const override {
    if (query.scattering.purely_discrete()) return nullptr;
    const SpatialMixture::View view = mixture_->mixture_at(query, arena);
    if (view.components.empty()) return nullptr;
    const SeenMixture* seen = SeenMixture::make(view.components, query.current.position,
                                                rule_at(query), technique_, arena);
    return seen == nullptr ? nullptr : arena.make<SeenDistribution>(*seen, view.region);
  }

 private:
  /// Media have no normal, and so no cosine.
  CosineRule rule_at(const GuidingQuery& query) const {
    CosineRule rule{.least = settings_.least_cosine};
    if (!settings_.reweight || query.current.kind != VertexKind::surface) return rule;
    const Vec3 n = query.current.shading_normal;
    rule.normal = dot(n, query.towards_previous) < 0 ? -n : n;
    rule.both_sides = contains(query.scattering.events(), Event::smooth_transmit);
    return rule;
  }

  std::shared_ptr<const SpatialMixture> mixture_;
  SeenSettings settings_;
  Technique technique_;
};

}  // namespace

void SeenSettings::describe(Schema<SeenSettings>& s) {
  s.field("reweight", &SeenSettings::reweight,
          "Multiply weights by the cosine between the normal and the direction to each mean");
  s.field("least_cosine", &SeenSettings::least_cosine,
          "Counts in place of smaller cosines: components that are half visible stay")
      .at_least(1e-6)
      .at_most(1);
}

GuiderTraits MixtureGuider::traits() const {
  return {.model = std::string(kSpatialMixtureModel)};
}

std::unique_ptr<const BoundGuider> MixtureGuider::bind(
    std::shared_ptr<const GuidingModel> model) const {
  return std::make_unique<BoundMixtureGuider>(bind_model<SpatialMixture>(model, *this), settings_,
                                              technique_);
}

}  // namespace pharos::spatial_gaussians
