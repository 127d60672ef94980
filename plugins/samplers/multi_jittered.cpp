// multi_jittered: correlated multi-jittered sampling (Kensler 2013, "Correlated Multi-Jittered
// Sampling", Pixar Technical Memo 13-01). The n = m k samples of a set lie one each in the cells of
// a grid of m columns and k rows. They also lie one each in n equal intervals of x, and of y. The
// place of a point within its column is its row after a permutation of the rows, which all columns
// share. The place of a point within its row is its column before the columns are permuted. Sharing
// the permutations keeps neighbors apart. Each dimension of a pixel has its own permutations,
// jitter and order of the cells. Samples beyond a set belong to the next set, which has its own
// permutations.
//
// If n is not a product of two similar numbers, the last row is not full, as in Kensler's second
// form. The n intervals of y still hold one point each; of the m k intervals of x some remain
// empty. Each row is as high as m of the intervals of y, the last row as high as fewer.
//
// Sharing the permutations has a disadvantage. All columns misplace their points in the same way,
// which adds up if a smooth integrand has different values at opposite borders and the difference
// changes along the other axis (as for x y). The variance then falls only as n^-1.5. It falls as
// n^-2 if every column and every row has its own permutation (`correlated: false`; Chiu, Shirley
// and Wang 1994, "Multi-Jittered Sampling"). On edges both variants fall as n^-1.5.
//
//     { type: multi_jittered, samples: 16 }
#include "multi_jittered.h"

#include "strata.h"

namespace pharos {
namespace {

class PreparedMultiJittered final : public PreparedSampler {
 public:
  /// `seed` draws the permutations.
  PreparedMultiJittered(std::uint32_t samples, bool correlated, std::uint64_t seed)
      : grid_(grid_of(samples)),
        samples_(samples),
        places_(grid_),
        cells_(grid_.cells()),
        numbers_(samples),
        orders_(samples, hash_combine(seed, 0)),
        column_orders_(grid_.columns, hash_combine(seed, 1)),
        row_orders_(grid_.rows, hash_combine(seed, 2)),
        apart_(correlated ? 0 : 0x9e3779b1u) {}

  std::uint64_t begin(const PathKey& key) const override {
    return SetPlace::of(key, samples_).state();
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    return stratified_number(place.index(), orders_, numbers_,
                             seeds_of(place.set_hash(), dimension));
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    const Seeds seeds = seeds_of(place.set_hash(), dimension);
    const std::uint32_t y = orders_.through_one(place.index(), seeds.order);
    const auto [number, row] = places_[y];
    const std::uint32_t column = column_orders_.through_one(number, seeds.y ^ (row * apart_));
    const std::uint32_t x =
        column * grid_.rows + row_orders_.through_one(row, seeds.x ^ (column * apart_));
    const std::uint64_t jitter = jitter_bits(place.index(), seeds);
    return {cells_.at(x, static_cast<std::uint32_t>(jitter >> 32)),
            numbers_.at(y, static_cast<std::uint32_t>(jitter))};
  }

 private:
  StrataGrid grid_;
  std::uint32_t samples_;
  GridCells places_;
  Strata cells_, numbers_;
  DrawnPermutations orders_, column_orders_, row_orders_;
  std::uint32_t apart_;  ///< factor that separates the seeds of the columns, and of the rows; 0:
                         ///< all share a seed
};

}  // namespace

void MultiJitteredSampler::Settings::describe(Schema<Settings>& s) {
  describe_samples(s);
  s.field("correlated", &Settings::correlated,
          "Whether all columns, and all rows, share a permutation");
  s.example("{ samples: 7 }");
  s.example("{ samples: 32, correlated: false }");
}

std::unique_ptr<const PreparedSampler> MultiJitteredSampler::prepare(const PixelGrid&,
                                                                     const SamplePlan& plan,
                                                                     const IntegrandProbe*) const {
  return std::make_unique<PreparedMultiJittered>(set_size(settings_.samples, plan),
                                                 settings_.correlated, plan.seed);
}

std::uint32_t MultiJitteredSampler::preferred_samples(const SamplePlan& plan) const {
  if (!sets_are_passes(settings_.samples, plan)) return 1;
  return set_size(settings_.samples, plan);
}

}  // namespace pharos
