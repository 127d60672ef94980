// pmj02bn: `pmj02` with points that keep farther apart, after Christensen, Kensler and Kilpatrick
// (2018, "Progressive Multi-Jittered Sample Sequences"), who choose best candidates. The digits of
// earlier points, drawn at random long before, determine where the next points of a net lie. Best
// candidates for a single point could therefore move it within a tiny cell only. Here the
// candidates are scrambles: in the first 256 points halves of intervals change places if this moves
// points apart (blue_noise.h), for blocks of 4 up to 256 points. The sequence then continues from
// these points. It remains a random (0,2)-sequence and is used in the same way as the sequences of
// `pmj02`.
//
// Mean distances to the nearest neighbor grow by about a tenth up to 256 points, and hardly beyond.
// Nets have far fewer degrees of freedom than points, so true blue noise is impossible.
//
//     { type: pmj02bn }
#include "pmj02bn.h"

#include <pharos/core/random.h>

#include "blue_noise.h"
#include "pmj02_tables.h"

namespace pharos {

std::unique_ptr<const PreparedSampler> Pmj02bnSampler::prepare(const PixelGrid&,
                                                               const SamplePlan& plan,
                                                               const IntegrandProbe*) const {
  constexpr std::uint64_t kSequences = 4;
  constexpr int kApartBits = 8;
  const int bits = pmj02::table_bits(plan);
  std::vector<pmj02::Point> tables;
  for (std::uint64_t i = 0; i < kSequences; ++i) {
    const std::uint64_t seed = hash_combine(mix_bits(plan.seed), i);
    auto points = pmj02::sequence(kApartBits, seed);
    pmj02::move_apart(points, seed);
    while (points.size() < (std::size_t{1} << bits)) pmj02::double_sequence(points, seed);
    tables.insert(tables.end(), points.begin(), points.end());
  }
  return pmj02::make_sampler(std::move(tables), bits);
}

}  // namespace pharos
