#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <pharos/core/random.h>

#include "keyed_seeds.h"

namespace pharos {

/// Nested random permutations of several digits of a base at once: the digits before a digit select
/// its permutation. The permutations are drawn into tables. Each node of the tree of digits applies
/// two tables, one after the other. If `shifted` is set, a node applies one table and then shifts
/// its digits, so that all images of a value are exactly equally likely.
template <std::uint32_t base, std::uint32_t digits, bool shifted>
class DigitScramble {
 public:
  /// The number of permuted values: base to the power `digits`.
  static constexpr std::uint32_t kCount = [] {
    std::uint32_t count = 1;
    for (std::uint32_t i = 0; i < digits; ++i) count *= base;
    return count;
  }();

  explicit DigitScramble(std::uint64_t seed) {
    RandomStream random(seed);
    for (std::uint32_t t = 0; t < kTables; ++t) {
      const std::vector<std::uint8_t> images = drawn(random);
      std::copy(images.begin(), images.end(), images_.begin() + t * kCount);
    }
    for (std::uint32_t i = 0; i < sums_.size(); ++i) sums_[i] = digit_sum(i / kCount, i % kCount);
  }

  /// Returns the image of `value`, whose first digit is the most significant one, at the node whose
  /// place in the tree is `prefix`. `seed` selects the scramble of the whole tree.
  std::uint32_t operator()(std::uint32_t value, std::uint32_t prefix, std::uint64_t seed) const {
    const std::uint64_t hash = mix_sum(seed + prefix);
    if constexpr (!shifted) {
      const std::uint32_t first = images_[(hash >> 59) * kCount + value];
      return images_[((hash >> 54) % kTables) * kCount + first];
    } else {
      const auto choice = static_cast<std::uint32_t>(((hash >> 32) * (kTables * kCount)) >> 32);
      const std::uint32_t table = choice % kTables, shift = choice / kTables;
      return sums_[shift * kCount + images_[table * kCount + value]];
    }
  }

 private:
  static_assert(kCount <= 256);
  static constexpr std::uint32_t kTables = 32;  // five bits of a hash

  static std::vector<std::uint8_t> drawn(RandomStream& random) {
    std::vector<std::uint8_t> images{0};
    for (std::uint32_t d = 0; d < digits; ++d) {
      std::vector<std::uint8_t> longer;
      for (const std::uint8_t image : images) {
        for (const std::uint32_t digit : random_digits(random)) {
          longer.push_back(static_cast<std::uint8_t>(image * base + digit));
        }
      }
      images = std::move(longer);
    }
    return images;
  }

  /// Returns all digits in a random order.
  static std::array<std::uint32_t, base> random_digits(RandomStream& random) {
    std::array<std::uint32_t, base> order;
    std::iota(order.begin(), order.end(), 0);
    for (std::uint32_t i = base; i-- > 1;) std::swap(order[i], order[random() % (i + 1)]);
    return order;
  }

  /// Adds each pair of digits of `a` and `b` without carry.
  static std::uint8_t digit_sum(std::uint32_t a, std::uint32_t b) {
    std::uint32_t sum = 0, place = 1;
    for (std::uint32_t d = 0; d < digits; ++d, a /= base, b /= base, place *= base) {
      sum += (a + b) % base * place;
    }
    return static_cast<std::uint8_t>(sum);
  }

  std::array<std::uint8_t, kTables * kCount> images_;
  std::array<std::uint8_t, shifted ? kCount * kCount : 0> sums_;
};

}  // namespace pharos
