#pragma once

#include <pharos/guiding/contract/distribution.h>

#include "camera_mixture.h"

namespace pharos::vertex_triplets {

/// The distribution of first vertices of paths from one point of the lens (Schuessler et al. 2022,
/// section 5.4). Vertices on surfaces are sampled like all others, in the plane through a
/// component's mean. A vertex outside of the component's box is a zero sample. The hierarchy of
/// boxes therefore finds all components that could have sampled a vertex.
class FirstDistribution final : public GuidingDistribution {
 public:
  FirstDistribution(const CameraMixture& mixture, Point3 lens) : mixture_(mixture), lens_(lens) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override;
  float density(const ResolvedVertex& vertex) const override;

 private:
  const CameraMixture& mixture_;
  Point3 lens_;
};

}  // namespace pharos::vertex_triplets
