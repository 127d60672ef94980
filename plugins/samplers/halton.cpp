// halton: each dimension of a pixel is the Halton sequence of bases 2 and 3 (Halton 1960) with a
// nested scramble of its digits (Owen 1995, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences").
// Of any 2^a 3^b consecutive ones of its points one lies in each of the 2^a by 3^b equal cells of
// the square.
//
// Dimensions are padded: every one has these two bases, not the next primes. Paths ask for numbers
// by purpose, in hundreds of dimensions, and of large bases only thousands of samples would fill
// even the first digit. So that padded dimensions are unrelated, each goes through the sequence in
// an order of its own, with the digits of the index in base 6 permuted, the first digits first:
// prefixes of 6^k points stay blocks of consecutive points. So 6, 36, 216, 1296 samples are best;
// between, n = j 6^k are as even as j sets of 6^k. The shuffles are as long as the plan's samples
// need, 6^9 at most (6^6 with a time budget); further samples begin anew.
//
//     { type: halton }
#include "halton.h"

#include "digit_scramble.h"
#include "owen.h"
#include "strata.h"

namespace pharos {
namespace {

/// Indices are shuffled three digits of base 6 at a time, numbers in base 3 are scrambled four
/// digits at a time.
constexpr std::uint32_t kSixths = 216, kThirds = 81;

constexpr std::uint32_t power(std::uint32_t base, std::uint32_t exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// The four lowest digits of base 3 in the opposite order.
constexpr std::uint32_t reversed_thirds(std::uint32_t v) {
  return v % 3 * 27 + v / 3 % 3 * 9 + v / 9 % 3 * 3 + v / 27;
}

/// For sets of 216^groups samples; 1 to 3.
template <std::uint32_t groups>
class PreparedHalton final : public PreparedSampler {
 public:
  /// `seed` draws the permutations of digits.
  explicit PreparedHalton(std::uint64_t seed)
      : sixths_(hash_combine(seed, 1)), thirds_(hash_combine(seed, 2)) {
    for (std::uint32_t v = 0; v < kThirds; ++v) reversed_[v] = reversed_thirds(v);
  }

  std::uint64_t begin(const PathKey& key) const override {
    const std::uint32_t set = key.sample / kPeriod;
    return (hash_pixel(key, set) << kIndexBits) | (key.sample - set * kPeriod);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> kIndexBits, dimension);
    return owen::scrambled_number(shuffled(stream, seeds), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Seeds seeds = seeds_of(stream.state() >> kIndexBits, dimension);
    const std::uint32_t index = shuffled(stream, seeds);
    return {owen::scrambled_number(index, seeds.x), base_3(index, seeds)};
  }

 private:
  static constexpr std::uint32_t kPeriod = power(kSixths, groups);
  static constexpr std::uint32_t kThirdGroups = std::min(groups + 1, 3u);
  static constexpr Strata kStrata{power(kThirds, kThirdGroups)};
  /// Of the state: the number within the set, below 216^3. The others are a hash of pixel and set.
  static constexpr int kIndexBits = 24;
  /// Tells the places of groups apart.
  static constexpr std::uint64_t kNextPlace = 0x8cb92ba72f3d8dd7ull;

  /// Each group of digits is permuted as those before it, the quotient, say.
  std::uint32_t shuffled(const SampleStream& stream, const Seeds& seeds) const {
    auto rest = static_cast<std::uint32_t>(stream.state() & ((1u << kIndexBits) - 1));
    std::uint64_t seed = (std::uint64_t{seeds.order} << 32) | seeds.x;
    std::uint32_t image = 0, place = 1;
    for (std::uint32_t group = 0; group < groups; ++group) {
      const std::uint32_t before = rest / kSixths;
      image += place * sixths_(rest - before * kSixths, before, seed);
      rest = before;
      place *= kSixths;
      seed += kNextPlace;
    }
    return image;
  }

  /// The first digits of the number are the last ones of the index.
  float base_3(std::uint32_t index, const Seeds& seeds) const {
    std::uint64_t seed = (std::uint64_t{seeds.y} << 32) | seeds.more;
    std::uint32_t image = 0, before = 0, rest = index, place = 1;
    for (std::uint32_t group = 0; group < kThirdGroups; ++group) {
      const std::uint32_t quotient = rest / kThirds, digits = rest - quotient * kThirds;
      image = image * kThirds + thirds_(reversed_[digits], before, seed);
      before += place * digits;
      rest = quotient;
      place *= kThirds;
      seed += kNextPlace;
    }
    return kStrata.at(image, (index * 0x9e3779b1u) ^ seeds.order);
  }

  std::array<std::uint32_t, kThirds> reversed_;
  DigitScramble<6, 3, false> sixths_;
  DigitScramble<3, 4, true> thirds_;
};

}  // namespace

/// As many groups of digits as the plan's samples need; with a time budget sets have 6^6 samples.
std::unique_ptr<const PreparedSampler> HaltonSampler::prepare(const PixelGrid&,
                                                              const SamplePlan& plan,
                                                              const IntegrandProbe*) const {
  const std::uint32_t samples = plan.samples_per_pixel;
  if (samples > power(kSixths, 2)) return std::make_unique<PreparedHalton<3>>(plan.seed);
  if (samples > kSixths || samples == 0) return std::make_unique<PreparedHalton<2>>(plan.seed);
  return std::make_unique<PreparedHalton<1>>(plan.seed);
}

}  // namespace pharos
