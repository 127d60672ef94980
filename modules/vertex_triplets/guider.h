#pragma once

#include <memory>

#include <pharos/guiding/contract/guider.h>

#include "model.h"
#include "next_distribution.h"

namespace pharos::vertex_triplets {

struct VertexTripletsGuiderSettings {
  SurfaceTechnique surfaces = SurfaceTechnique::projected;
  float specular_roughness = 0.2f;
  float prefix_deviations = kTruncation;
  bool guide_camera = true;
  static void describe(Schema<VertexTripletsGuiderSettings>& schema);
};

/// Samples a model of vertex triplets or pairs: next vertices on surfaces and in media, discrete
/// events, distances, and first vertices (Schuessler et al. 2022, section 5).
class VertexTripletsGuider final : public GuiderOf<VertexTripletsModel> {
 public:
  using Settings = VertexTripletsGuiderSettings;
  explicit VertexTripletsGuider(const Settings& settings) : settings_(settings) {}

  GuiderTraits traits() const override;
  const GuidingDistribution* query(const VertexTripletsModel& model, const GuidingQuery& query,
                                   Arena& arena) const override;

 private:
  Settings settings_;
};

}  // namespace pharos::vertex_triplets
