// uniform (guider): samples directions uniformly over the whole sphere, with density 1/(4 pi)
// [1/sr]. On opaque surfaces half of the directions point inside and are samples of value zero.
// This is the worst guide that still finds everything. A learned guide must be better than it.
//
//     guiding: { learner: uniform, guider: uniform }
#include "uniform_guider.h"

#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// The answer to one query. A guide that looks something up in its model keeps the result here.
class UniformDistribution final : public GuidingDistribution {
 public:
  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return propose_direction(warp::sphere_from_square(stream.get_2d(Purpose::guide_direction)));
  }

  /// Returns the density of propose() for any vertex, whichever technique found the vertex. In
  /// media this is the density of the direction alone; the framework multiplies it by the density
  /// of the distance.
  float density(const ResolvedVertex&) const override { return warp::sphere_pdf(); }
};

}  // namespace

/// Answers every query. The framework does not ask if UniformModel::place() has reported evidence
/// 0. It does not ask at vertices whose events are all discrete either, because
/// GuiderTraits::steers_events is false.
const GuidingDistribution* UniformGuider::query(const UniformModel&, const GuidingQuery&,
                                                Arena& arena) const {
  return arena.make<UniformDistribution>();
}

}  // namespace pharos
