// stratified: jittered sampling (Cook 1986, "Stochastic Sampling in Computer Graphics"). The n
// samples of a set lie one each in the n cells of a grid over the unit square, and in n intervals
// of equal length in 1D, uniformly within their cell. Each dimension of a pixel takes the cells in
// an order of its own. Samples beyond a set belong to the next one, which is jittered anew.
//
// An n that is no product of two similar numbers (37) gets a grid with a few cells to spare (6 by
// 7): passes of that size fill it; fewer samples leave cells out, by chance and without bias.
//
//     { type: stratified, samples: 16 }
#include "stratified.h"

#include "strata.h"

namespace pharos {
namespace {

class PreparedStratified final : public PreparedSampler {
 public:
  /// `seed` draws the orders of cells.
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
