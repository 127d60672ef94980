// sobol: each dimension of a pixel uses the first two dimensions of Sobol's sequence, a
// (0,2)-sequence, with its own Owen scramble and its own order (padding; Kollig and Keller 2002,
// Burley 2020, "Practical Hash-based Owen Scrambling"). If n is a power of two, the first n samples
// of a pixel are stratified in every elementary interval of area 1/n of every 2D dimension.
// Different dimensions, pixels, iterations and seeds are unrelated. Any number of samples is
// possible; powers of two are best.
//
//     { type: sobol }
#include "sobol.h"

#include "keyed_seeds.h"
#include "owen.h"

namespace pharos {
namespace {

class PreparedSobol final : public PreparedSampler {
 public:
  /// Packs a hash that all samples of a pixel share into the upper half of the state, and the
  /// reversed number of the sample into the lower half.
  std::uint64_t begin(const PathKey& key) const override {
    return (hash_pixel(key) & 0xffffffff00000000ull) | owen::reverse_bits(key.sample);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> 32, dimension);
    return owen::sobol_number(shuffled(stream, seeds), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> 32, dimension);
    return owen::sobol_point(shuffled(stream, seeds), seeds.x, seeds.y);
  }

 private:
  /// Returns the place of the sample in the sequence, reversed.
  static std::uint32_t shuffled(const SampleStream& stream, const Seeds& seeds) {
    return owen::scramble_reversed(static_cast<std::uint32_t>(stream.state()), seeds.order);
  }
};

}  // namespace

std::unique_ptr<const PreparedSampler> SobolSampler::prepare(const PixelGrid&, const SamplePlan&,
                                                             const IntegrandProbe*) const {
  return std::make_unique<PreparedSobol>();
}

}  // namespace pharos
