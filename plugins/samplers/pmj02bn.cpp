// pmj02bn: `pmj02` with points that keep farther apart (after Christensen, Kensler and Kilpatrick
// 2018, "Progressive Multi-Jittered Sample Sequences", who pick best candidates). Where the points
// of a net lie follows from the digits of earlier points, which were drawn at random, long before:
// best candidates for a point itself could move it within a tiny cell only. So the candidates are
// scrambles here: in the first 256 points halves of intervals change places wherever that takes
// points out of each other's way (blue_noise.h), for blocks of 4 up to 256 points, then the
// sequence goes on from these. It stays a random (0,2)-sequence, used like those of `pmj02`.
//
// Mean distances to the nearest neighbor grow by about a tenth up to 256 points, and hardly beyond
// that. Nets have far fewer degrees of freedom than points: true blue noise is out of reach.
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
