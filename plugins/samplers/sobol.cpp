// sobol: each dimension of a pixel runs through the first two dimensions of Sobol's sequence, a
// (0,2)-sequence, with an Owen scramble and an order of its own (padding; Kollig and Keller 2002,
// Burley 2020, "Practical Hash-based Owen Scrambling"). So the first n samples of a pixel, n a
// power of two, are stratified in every elementary interval of area 1/n of every 2D dimension, and
// different dimensions, pixels, iterations and seeds are unrelated. Any number of samples is fine;
// powers of two are best.
//
//     { type: sobol }
#include "sobol.h"

#include "keyed_seeds.h"
#include "owen.h"

namespace pharos {
namespace {

class PreparedSobol final : public PreparedSampler {
 public:
  /// What all samples of a pixel share; the sample's number comes from the key.
  std::uint64_t begin(const PathKey& key) const override { return hash_pixel(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state(), dimension);
    const std::uint32_t index = owen::shuffle_index(stream.key().sample, seeds.order);
    return owen::scrambled_number(owen::sobol_x_reversed(index), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state(), dimension);
    const std::uint32_t index = owen::shuffle_index(stream.key().sample, seeds.order);
    return {owen::scrambled_number(owen::sobol_x_reversed(index), seeds.x),
            owen::scrambled_number(owen::sobol_y_reversed(index), seeds.y)};
  }
};

}  // namespace

std::unique_ptr<const PreparedSampler> SobolSampler::prepare(const PixelGrid&, const SamplePlan&,
                                                             const IntegrandProbe*) const {
  return std::make_unique<PreparedSobol>();
}

}  // namespace pharos
