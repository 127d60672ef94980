// z_sobol: one Sobol' sequence for the whole image, dealt out to the pixels along a shuffled
// z-order curve (Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling
// Error via Hierarchical Ordering of Pixels"). Each pixel takes the next n numbers, n a power of
// two. So the samples of any aligned square of 2^k by 2^k pixels together, and those of a pixel
// alone, are stratified in every elementary interval: errors of neighbours cancel, and the image's
// error looks like blue noise. Each dimension has an order, its (0,2)-sequence an Owen scramble of
// its own.
//
// Order: at each level of the quadtree of pixels the four children come in a random order,
// unrelated between nodes. It is made bit-parallel, in two steps: at each node one of three
// pairings of the four is chosen (by rows or by columns for a quarter each, else crosswise), then
// pairs and their members change places or not, which is an Owen scramble of the index. A pixel's
// own samples are shuffled by the latter only, so that every prefix of 2^j samples stays stratified
// as well.
//
// `samples` is rounded up to a power of two; a pixel that takes fewer uses a prefix. Where the
// number of samples is unknown (a time budget) sets of 16, or those stated, follow each other:
// within each set neighbours fit together, different sets are unrelated.
//
//     { type: z_sobol }
#include "z_sobol.h"

#include <bit>

#include "owen.h"

namespace pharos {
namespace {

/// Puts a zero above each of the 32 bits.
constexpr std::uint64_t spread(std::uint64_t v) {
  v = (v | (v << 16)) & 0x0000ffff0000ffffull;
  v = (v | (v << 8)) & 0x00ff00ff00ff00ffull;
  v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0full;
  v = (v | (v << 2)) & 0x3333333333333333ull;
  return (v | (v << 1)) & 0x5555555555555555ull;
}

class PreparedZSobol final : public PreparedSampler {
 public:
  PreparedZSobol(std::uint32_t width, std::uint32_t samples)
      : width_(width),
        sample_bits_(std::bit_width(samples - 1)),
        padding_(sample_bits_ % 2),
        pixel_digits_(0x55555555u >> (sample_bits_ + padding_)) {}

  /// Upper half: a hash of image and set, and of the place's higher digits; lower half: the 32 last
  /// bits of the place in the sequence, reversed. Places further apart take unrelated scrambles.
  std::uint64_t begin(const PathKey& key) const override {
    const std::uint64_t y = key.index / width_, x = key.index - y * width_;
    const std::uint64_t pixel = spread(x) | (spread(y) << 1);
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
    return owen::scrambled_number(owen::sobol_x_reversed(place(stream, seeds)), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> 32, dimension);
    const std::uint32_t index = place(stream, seeds);
    return owen::scrambled_point(owen::sobol_x_reversed(index), seeds.x,
                                 owen::sobol_y_reversed(index), seeds.y);
  }

 private:
  /// The shuffled place in the sequence.
  std::uint32_t place(const SampleStream& stream, const Seeds& seeds) const {
    const std::uint32_t paired = with_pairings(static_cast<std::uint32_t>(stream.state()), seeds);
    return owen::reverse_bits(owen::scramble_reversed(paired, seeds.order)) >> padding_;
  }

  /// Chooses which bit of each pixel's digit of base 4 tells the pairs apart: that of y (the first,
  /// at the even places of a reversed number), that of x, or their sum.
  std::uint32_t with_pairings(std::uint32_t reversed, const Seeds& seeds) const {
    // Products with odd numbers carry upwards only: bits at even places of these, once that place's
    // own bit is taken off, depend on the digits before theirs alone.
    const std::uint32_t product = (reversed + seeds.x) * ((seeds.order << 1) | 1);
    const std::uint32_t a = product ^ (product * 0x05526c56u) ^ reversed;
    const std::uint32_t b = a * 0x9e3779b1u;
    const std::uint32_t differ = (reversed ^ (reversed >> 1)) & a & pixel_digits_;
    const std::uint32_t swapped = reversed ^ differ ^ (differ << 1);
    return swapped ^ ((swapped >> 1) & b & pixel_digits_);
  }

  std::uint64_t width_;
  int sample_bits_;             ///< of a set's size
  int padding_;                 ///< a bit that lets the pixels' digits begin at an even place
  std::uint32_t pixel_digits_;  ///< even places of the reversed digits of pixels
};

}  // namespace

std::unique_ptr<const PreparedSampler> ZSobolSampler::prepare(const PixelGrid& grid,
                                                              const SamplePlan& plan,
                                                              const IntegrandProbe*) const {
  return std::make_unique<PreparedZSobol>(static_cast<std::uint32_t>(std::max(grid.width, 1)),
                                          std::bit_ceil(set_size(settings_.samples, plan)));
}

std::uint32_t ZSobolSampler::preferred_samples() const {
  return settings_.samples ? std::bit_ceil(*settings_.samples) : 1;
}

}  // namespace pharos
