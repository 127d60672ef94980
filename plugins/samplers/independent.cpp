// independent: every number is a hash of the path's key and the dimension, unrelated to all others.
//
//     { type: independent }
#include "independent.h"

#include <pharos/core/random.h>

namespace pharos {
namespace {

class PreparedIndependent final : public PreparedSampler {
 public:
  std::uint64_t begin(const PathKey& key) const override {
    const std::uint64_t image = hash_combine(mix_bits(key.seed), key.iteration);
    return hash_combine(hash_combine(image, key.index), key.sample);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return to_unit_vec2(bits(stream, dimension)).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return to_unit_vec2(bits(stream, dimension));
  }

 private:
  /// Returns the word of the path's own SplitMix64 stream at the place of the dimension.
  static std::uint64_t bits(const SampleStream& stream, Dimension dimension) {
    return mix_bits(stream.state() + dimension.code() * 0x9e3779b97f4a7c15ull);
  }
};

}  // namespace

std::unique_ptr<const PreparedSampler> IndependentSampler::prepare(const PixelGrid&,
                                                                   const SamplePlan&,
                                                                   const IntegrandProbe*) const {
  return std::make_unique<PreparedIndependent>();
}

}  // namespace pharos
