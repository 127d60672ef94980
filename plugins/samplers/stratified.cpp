// stratified: jittered sampling (Cook 1986, "Stochastic Sampling in Computer Graphics"). The n
// samples of a set lie one each in the n cells of a grid over the unit square, and one each in n
// equal intervals in 1D, uniformly distributed within their cell. Each dimension of a pixel visits
// the cells in its own order. Samples beyond a set belong to the next set, which is jittered anew.
//
// If n is not a product of two similar numbers (37), the grid has a few spare cells (6 by 7).
// Passes of the size of the grid fill it. Fewer samples leave cells out at random and without bias.
//
//     { type: stratified, samples: 16 }
#include "stratified.h"

#include "strata.h"

namespace pharos {
namespace {

class PreparedStratified final : public PreparedSampler {
 public:
  /// `seed` draws the orders of the cells.
  PreparedStratified(StrataGrid grid, std::uint64_t seed)
      : grid_(grid),
        places_(grid),
        columns_(grid.columns),
        rows_(grid.rows),
        cells_(grid.cells()),
        orders_(grid.cells(), seed) {}

  std::uint64_t begin(const PathKey& key) const override {
    return SetPlace::of(key, grid_.cells()).state();
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    return stratified_number(place.index(), orders_, cells_, seeds_of(place.set_hash(), dimension));
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    const Seeds seeds = seeds_of(place.set_hash(), dimension);
    const auto [column, row] = places_[orders_(place.index(), seeds.order)];
    const std::uint64_t jitter = jitter_bits(place.index(), seeds);
    return {columns_.at(column, static_cast<std::uint32_t>(jitter >> 32)),
            rows_.at(row, static_cast<std::uint32_t>(jitter))};
  }

 private:
  StrataGrid grid_;
  GridCells places_;
  Strata columns_, rows_, cells_;
  DrawnPermutations orders_;
};

}  // namespace

std::unique_ptr<const PreparedSampler> StratifiedSampler::prepare(const PixelGrid&,
                                                                  const SamplePlan& plan,
                                                                  const IntegrandProbe*) const {
  return std::make_unique<PreparedStratified>(grid_of(set_size(settings_.samples, plan)),
                                              plan.seed);
}

std::uint32_t StratifiedSampler::preferred_samples(const SamplePlan& plan) const {
  if (!sets_are_passes(settings_.samples, plan)) return 1;
  return grid_of(set_size(settings_.samples, plan)).cells();
}

}  // namespace pharos
