// pmj02: progressive multi-jittered (0,2) sequences (Christensen, Kensler and Kilpatrick 2018,
// "Progressive Multi-Jittered Sample Sequences"): random points whose first n, n any power of two,
// have one point in every elementary interval of area 1/n.
//
// When n points double, each interval of length 1/n of x holds one old point and must get one new
// point in its other half; the same holds for y, and which new x goes with which new y follows from
// the elementary intervals between. So what Christensen et al. search for among random candidates
// can be written down: copy the first k digits, k = log2 n, of two old numbers, flip digit k + 1,
// draw the rest at random (Helmer, Christensen and Kensler 2021, "Stochastic Generation of (t, s)
// Sample Sequences"). With the partners that Sobol's matrices give every aligned block of 2^j
// points is a net, not only the first. In distribution that is Sobol's sequence with Owen's
// scrambling, as `sobol` has it, but with digits that are drawn instead of hashed.
//
// Eight sequences are made before rendering, as long as the samples of a pixel, at least 256 points
// and at most 65,536 (4,096 with a time budget); every dimension of a pixel takes one, in an order
// and with digits flipped at random of its own. Samples beyond a table begin anew.
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
