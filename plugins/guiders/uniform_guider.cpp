// uniform (guider): directions uniform over the whole sphere, with density 1/(4 pi) [1/sr]. On
// opaque surfaces half of them point inside and are samples of value zero, so that this is the
// worst guide that still finds everything: what a learned one must beat.
//
//     guiding: { learner: uniform, guider: uniform }
#include "uniform_guider.h"

#include <pharos/core/warp.h>

#include "uniform_model.h"

namespace pharos {
namespace {

/// The answer to one query. A guide that had looked something up would carry it here, and would
/// name the model's region it came from in region().
class UniformDistribution final : public GuidingDistribution {
 public:
  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return Proposal{.direction = warp::sphere_from_square(stream.get_2d(Purpose::guide_direction))};
  }

  /// Must be the density of propose() for any vertex, whoever found it. In media this is the
  /// density of the direction alone: the caller multiplies by that of the distance.
  Density density(const ResolvedVertex&) const override {
    return {warp::sphere_pdf(), Measure::solid_angle};
  }
};

class BoundUniformGuider final : public BoundGuider {
 public:
  explicit BoundUniformGuider(std::shared_ptr<const UniformModel> model)
      : model_(std::move(model)) {}

  /// Null where nothing is known: here, while no path has met any light. The answer may depend on
  /// the model and the query only. Purely discrete vertices need no check: as the traits promise no
  /// discrete events, the framework does not ask there.
  const GuidingDistribution* query(const GuidingQuery& query, Arena& arena) const override {
    if (model_->density(query.current.position) == 0) return nullptr;
    return arena.make<UniformDistribution>();
  }

 private:
  std::shared_ptr<const UniformModel> model_;
};

}  // namespace

GuiderTraits UniformGuider::traits() const {
  return {.model = UniformModel::kName, .guides_light_paths = true};
}

std::unique_ptr<const BoundGuider> UniformGuider::bind(
    std::shared_ptr<const GuidingModel> model) const {
  return std::make_unique<BoundUniformGuider>(bind_model<UniformModel>(model, *this));
}

}  // namespace pharos
