#include "guider.h"

#include "first_distribution.h"
#include "model.h"

namespace pharos::vertex_triplets {
namespace {

/// Events that something comes of: total reflection, for one, leaves nothing of transmission.
EventMask possible_events(const LocalScattering& scattering) {
  EventMask events = scattering.events() & EventMask::smooth;
  if (events == scattering.events()) return events;
  for (const DiscreteOutcome& outcome : scattering.discrete()) {
    events = events | mask_of(outcome.event);
  }
  return events;
}

class BoundTripletGuider final : public BoundGuider, public CameraGuider {
 public:
  BoundTripletGuider(std::shared_ptr<const VertexTripletsModel> model,
                     const VertexTripletsGuiderSettings& settings)
      : model_(std::move(model)),
        rules_{settings.surfaces, settings.specular_roughness},
        guides_camera_(settings.guide_camera) {}

  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const override {
    const std::span<const NextVertex> next =
        model_->next_vertices(query, possible_events(query.scattering), arena);
    if (next.empty()) return nullptr;
    const std::uint32_t cell = model_->region_at(query.current.position);
    constexpr float kLeastDistance = 1e-6f;  // of the cell's edge
    return NextDistribution::make(next, query.scattering, query.current.position, rules_,
                                  kLeastDistance * model_->cell_size(cell), cell, arena);
  }

  const CameraGuider* camera() const override {
    return guides_camera_ && !model_->camera().empty() ? this : nullptr;
  }
  const GuidingDistribution* query_camera(const PreparedSensor&, const LensPoint& lens,
                                          Arena& arena) const override {
    return arena.make<FirstDistribution>(model_->camera(), lens.position);
  }

 private:
  std::shared_ptr<const VertexTripletsModel> model_;
  StepRules rules_;
  bool guides_camera_;
};

}  // namespace

void VertexTripletsGuiderSettings::describe(Schema<VertexTripletsGuiderSettings>& s) {
  s.field("surfaces", &VertexTripletsGuiderSettings::surfaces,
          "How directions to surfaces and the environment are made from Gaussians: projected on a "
          "plane (the paper), or to their points (p0, p1)");
  s.field("specular_roughness", &VertexTripletsGuiderSettings::specular_roughness,
          "Below this square root of GGX alpha, or of 1 - |g|, directions are more and more left "
          "to BSDF and phase function")
      .above(0);
  s.field("guide_camera", &VertexTripletsGuiderSettings::guide_camera,
          "Whether first vertices, and so pixels, are guided");
}

GuiderTraits VertexTripletsGuider::traits() const {
  return {.model = VertexTripletsModel::kName,
          .steers_distance = true,
          .steers_events = true,
          .guides_camera = settings_.guide_camera,
          .guides_light_paths = true};
}

std::unique_ptr<const BoundGuider> VertexTripletsGuider::bind(
    std::shared_ptr<const GuidingModel> model) const {
  return std::make_unique<BoundTripletGuider>(bind_model<VertexTripletsModel>(model, *this),
                                              settings_);
}

}  // namespace pharos::vertex_triplets
