// z_sobol: one Sobol' sequence for the whole image, distributed to the pixels along a shuffled
// z-order curve (Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling
// Error via Hierarchical Ordering of Pixels"). Each pixel takes the next n numbers, where n is a
// power of two. The samples of any aligned square of 2^k by 2^k pixels together, and the samples of
// a single pixel, are therefore stratified in every elementary interval. Errors of neighbors
// cancel, and the error of the image looks like blue noise. Each dimension has its own order, and
// an Owen scramble of its own for its (0,2)-sequence.
//
// At each level of the quadtree of pixels the four children come in a random order, unrelated
// between nodes. The order is computed bit-parallel in two steps. First, each node chooses one of
// three pairings of its four children: by rows or by columns for a quarter of the nodes each,
// otherwise crosswise. Then pairs, and the members of a pair, change places or not, which is an
// Owen scramble of the index. The second step alone shuffles a pixel's own samples, so that every
// prefix of 2^j samples remains stratified as well.
//
// `samples` is rounded up to a power of two; a pixel that takes fewer samples uses a prefix. If the
// number of samples is unknown (a time budget), sets of 16 samples, or of the stated size, follow
// each other. Within a set neighbors complement each other; different sets are unrelated.
//
//     { type: z_sobol }
#include "z_sobol.h"

#include <bit>

#include "owen.h"
#include "z_order.h"

namespace pharos {
namespace {

class PreparedZSobol final : public PreparedSampler {
 public:
  PreparedZSobol(std::uint32_t width, std::uint32_t samples)
      : width_(width),
        sample_bits_(std::bit_width(samples - 1)),
        padding_(sample_bits_ % 2),
        pixel_digits_(0x55555555u >> (sample_bits_ + padding_)) {}

  /// Packs a hash of the image, the set and the higher digits of the place into the upper half of
  /// the state, and the last 32 bits of the place in the sequence, reversed, into the lower half.
  /// Places that differ in the higher digits use unrelated scrambles.
  std::uint64_t begin(const PathKey& key) const override {
    const std::uint64_t y = key.index / width_, x = key.index - y * width_;
    const std::uint64_t pixel = z_order::spread(x) | (z_order::spread(y) << 1);
    const int bits = sample_bits_ + padding_;
    const std::uint32_t set = key.sample >> sample_bits_;
    const std::uint32_t sample = key.sample - (set << sample_bits_);
    const auto place = static_cast<std::uint32_t>((pixel << bits) | (sample << padding_));
    const PathKey block{key.seed, key.iteration, pixel >> (32 - bits), 0};
    const std::uint64_t hash = hash_pixel(block, set);
    return (hash & 0xffffffff00000000ull) | owen::reverse_bits(place);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> 32, dimension);
    return owen::sobol_number(place(stream, seeds), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> 32, dimension);
    return owen::sobol_point(place(stream, seeds), seeds.x, seeds.y);
  }

 private:
  /// Returns the shuffled place in the sequence, reversed.
  std::uint32_t place(const SampleStream& stream, const Seeds& seeds) const {
    const auto reversed = static_cast<std::uint32_t>(stream.state());
    const std::uint32_t paired = z_order::with_pairings(reversed, seeds, pixel_digits_);
    return owen::scramble_reversed(paired, seeds.order) << padding_;
  }

  std::uint64_t width_;
  int sample_bits_;             ///< bits of the size of a set
  int padding_;                 ///< one bit if needed, so that the digits of pixels begin at an
                                ///< even place
  std::uint32_t pixel_digits_;  ///< even places of the reversed digits of pixels
};

}  // namespace

std::unique_ptr<const PreparedSampler> ZSobolSampler::prepare(const PixelGrid& grid,
                                                              const SamplePlan& plan,
                                                              const IntegrandProbe*) const {
  return std::make_unique<PreparedZSobol>(static_cast<std::uint32_t>(std::max(grid.width, 1)),
                                          std::bit_ceil(set_size(settings_.samples, plan)));
}

std::uint32_t ZSobolSampler::preferred_samples(const SamplePlan& plan) const {
  if (!sets_are_passes(settings_.samples, plan)) return 1;
  return std::bit_ceil(set_size(settings_.samples, plan));
}

}  // namespace pharos
