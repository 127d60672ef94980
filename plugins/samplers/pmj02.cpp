// pmj02: progressive multi-jittered (0,2) sequences (Christensen, Kensler and Kilpatrick 2018,
// "Progressive Multi-Jittered Sample Sequences"). The points are random, and for any power of two n
// the first n points lie one each in every elementary interval of area 1/n.
//
// When n points double, each interval of length 1/n of x holds one old point and must get one new
// point in its other half. The same holds for y. The elementary intervals between determine which
// new x goes with which new y. Christensen et al. search for such points among random candidates,
// but the points can be constructed directly: copy the first k = log2 n digits of two old numbers,
// flip digit k + 1, and draw the others at random (Helmer, Christensen and Kensler 2021,
// "Stochastic Generation of (t, s) Sample Sequences"). With the partners given by Sobol's matrices
// every aligned block of 2^j points is a net, not only the first block. In distribution this is
// Sobol's sequence with Owen's scrambling, the sequence of `sobol`, except that the digits are
// drawn instead of hashed.
//
// Eight sequences are made before rendering. They are as long as the samples of a pixel, at least
// 256 points and at most 65,536 points (4,096 with a time budget). Every dimension of a pixel uses
// one sequence in its own order and with its own randomly flipped digits. Samples beyond a table
// begin a new set.
//
//     { type: pmj02 }
#include "pmj02.h"

#include <pharos/core/random.h>

#include "pmj02_tables.h"

namespace pharos {

std::unique_ptr<const PreparedSampler> Pmj02Sampler::prepare(const PixelGrid&,
                                                             const SamplePlan& plan,
                                                             const IntegrandProbe*) const {
  constexpr std::uint64_t kSequences = 8;
  const int bits = pmj02::table_bits(plan);
  std::vector<pmj02::Point> tables;
  for (std::uint64_t i = 0; i < kSequences; ++i) {
    const auto points = pmj02::sequence(bits, hash_combine(mix_bits(plan.seed), i));
    tables.insert(tables.end(), points.begin(), points.end());
  }
  return pmj02::make_sampler(std::move(tables), bits);
}

}  // namespace pharos
