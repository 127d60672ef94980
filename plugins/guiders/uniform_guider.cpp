// uniform (guider): directions uniform over the whole sphere, with density 1/(4 pi) [1/sr]. On
// opaque surfaces half of them point inside and are samples of value zero. So this is the worst
// guide that still finds everything, and a learned guide must beat it.
//
//     guiding: { learner: uniform, guider: uniform }
#include "uniform_guider.h"

#include <pharos/core/warp.h>

namespace pharos {
namespace {

/// The answer to one query. A guide that looks something up in its model keeps it here.
class UniformDistribution final : public GuidingDistribution {
 public:
  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return Proposal{.direction = warp::sphere_from_square(stream.get_2d(Purpose::guide_direction))};
  }

  /// Must be the density of propose() for any vertex, whichever technique found it. In media this
  /// is the density of the direction alone; the framework multiplies by the density of the
  /// distance.
  float density(const ResolvedVertex&) const override { return warp::sphere_pdf(); }
};

}  // namespace

/// The framework does not ask where UniformModel::place() says that nothing is known, nor at
/// vertices with discrete events only, because the traits promise none.
const GuidingDistribution* UniformGuider::query(const UniformModel&, const GuidingQuery&,
                                                Arena& arena) const {
  return arena.make<UniformDistribution>();
}

}  // namespace pharos
