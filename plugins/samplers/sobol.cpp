// sobol: each dimension of a pixel runs through the first two dimensions of Sobol's sequence, a
// (0,2)-sequence, with an Owen scramble and an order of its own (padding; Kollig and Keller 2002,
// Burley 2020, "Practical Hash-based Owen Scrambling"). So the first n samples of a pixel, n a
// power of two, are stratified in every elementary interval of area 1/n of every 2D dimension, and
// different dimensions, pixels, iterations and seeds are unrelated. Any number of samples is fine;
// powers of two are best.
//
//     { type: sobol }
#include "sobol.h"

#include <pharos/core/random.h>

#include "owen.h"

namespace pharos {
namespace {

/// The seeds of one dimension of one pixel.
struct Seeds {
  std::uint32_t order, x, y;
};

Seeds seeds_of(const SampleStream& stream, Dimension dimension) {
  const std::uint64_t first = hash_combine(stream.state(), dimension.code());
  const std::uint64_t second = mix_bits(first + 0x9e3779b97f4a7c15ull);
  return {static_cast<std::uint32_t>(first >> 32), static_cast<std::uint32_t>(first),
          static_cast<std::uint32_t>(second >> 32)};
}

float scrambled(std::uint32_t reversed, std::uint32_t seed) {
  return to_unit_float(owen::reverse_bits(owen::scramble_reversed(reversed, seed)));
}

class PreparedSobol final : public PreparedSampler {
 public:
  /// What all samples of a pixel share; the sample's number comes from the key.
  std::uint64_t begin(const PathKey& key) const override {
    return hash_combine(hash_combine(mix_bits(key.seed), key.iteration), key.index);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream, dimension);
    const std::uint32_t index = owen::shuffle_index(stream.key().sample, seeds.order);
    return scrambled(owen::sobol_x_reversed(index), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream, dimension);
    const std::uint32_t index = owen::shuffle_index(stream.key().sample, seeds.order);
    return {scrambled(owen::sobol_x_reversed(index), seeds.x),
            scrambled(owen::sobol_y_reversed(index), seeds.y)};
  }
};

}  // namespace

std::unique_ptr<const PreparedSampler> SobolSampler::prepare(const PixelGrid&, const SamplePlan&,
                                                             const IntegrandProbe*) const {
  return std::make_unique<PreparedSobol>();
}

}  // namespace pharos
