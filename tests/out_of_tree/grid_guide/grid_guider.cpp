#include "grid_guider.h"

namespace grid_guide {

using namespace pharos;

namespace {

/// The answer to one query: the histogram of a cell.
class GridDistribution final : public GuidingDistribution {
 public:
  GridDistribution(const GridModel& model, std::uint32_t cell) : model_(&model), cell_(cell) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    return propose_direction(model_->sample(cell_, stream.get_2d(Purpose::guide_direction)));
  }
  float density(const ResolvedVertex& vertex) const override {
    return model_->pdf(cell_, vertex.direction);
  }

 private:
  const GridModel* model_;
  std::uint32_t cell_;
};

}  // namespace

/// GridModel::place() has found the cell before. The framework does not ask in cells without
/// evidence.
const GuidingDistribution* GridGuider::query(const GridModel& model, const GuidingQuery& query,
                                             Arena& arena) const {
  return arena.make<GridDistribution>(model, query.region);
}

}  // namespace grid_guide
