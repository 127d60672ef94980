// halton: each dimension of a pixel is the Halton sequence of bases 2 and 3 (Halton 1960) with a
// nested scramble of its digits (Owen 1995, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences").
// Any 2^a 3^b consecutive points of it lie one each in the 2^a by 3^b equal cells of the square.
//
// Dimensions are padded: each has these two bases instead of the next primes. Paths request numbers
// by purpose, in hundreds of dimensions, and thousands of samples would be needed to fill even the
// first digit of a large base. To make the padded dimensions unrelated, each visits the sequence in
// its own order: it permutes the digits of the index in base 6, the first digits first. Prefixes of
// 6^k points remain blocks of consecutive points. The best numbers of samples are therefore 6, 36,
// 216 and 1296; between them, n = j 6^k points are as even as j sets of 6^k. The shuffles cover as
// many samples as the plan needs, at most 6^9 (6^6 with a time budget). Further samples begin a new
// set.
//
//     { type: halton }
#include "halton.h"

#include "digit_scramble.h"
#include "owen.h"
#include "strata.h"

namespace pharos {
namespace {

/// The shuffle of indices permutes three digits of base 6 at a time; the scramble of numbers in
/// base 3 permutes four digits at a time.
constexpr std::uint32_t kSixths = 216, kThirds = 81;

constexpr std::uint32_t power(std::uint32_t base, std::uint32_t exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Reverses the order of the four lowest digits in base 3.
constexpr std::uint32_t reversed_thirds(std::uint32_t v) {
  return v % 3 * 27 + v / 3 % 3 * 9 + v / 9 % 3 * 3 + v / 27;
}

/// A prepared sampler with sets of 216^groups samples, for 1 to 3 groups.
template <std::uint32_t groups>
class PreparedHalton final : public PreparedSampler {
 public:
  /// `seed` draws the permutations of the digits.
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
  /// Bits of the state that hold the number within the set, below 216^3. The other bits hold a hash
  /// of the pixel and the set.
  static constexpr int kIndexBits = 24;
  /// Added to the seed from group to group, so that the groups are permuted differently.
  static constexpr std::uint64_t kNextPlace = 0x8cb92ba72f3d8dd7ull;

  /// Permutes each group of digits in a way that depends on the quotient `before`, the digits
  /// before the group.
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

  /// Returns the number in base 3. Its first digits are the last digits of the index.
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

/// Chooses as many groups of digits as the samples of the plan need. With a time budget sets have
/// 6^6 samples.
std::unique_ptr<const PreparedSampler> HaltonSampler::prepare(const PixelGrid&,
                                                              const SamplePlan& plan,
                                                              const IntegrandProbe*) const {
  const std::uint32_t samples = plan.samples_per_pixel;
  if (samples > power(kSixths, 2)) return std::make_unique<PreparedHalton<3>>(plan.seed);
  if (samples > kSixths || samples == 0) return std::make_unique<PreparedHalton<2>>(plan.seed);
  return std::make_unique<PreparedHalton<1>>(plan.seed);
}

}  // namespace pharos
