#include <algorithm>
#include <cstring>

#include <pharos/guiding/contract/whitened_group.h>

namespace pharos {
namespace {

/// Four components as a structure of arrays.
struct Components4 {
  Transposed4 first, second, last;  ///< numbers 0 to 3, 4 to 7 and 6 to 9

  explicit Components4(const SpatialGaussian* four)
      : first(numbers(four, 0)), second(numbers(four, 4)), last(numbers(four, 6)) {}

 private:
  static Transposed4 numbers(const SpatialGaussian* four, std::size_t begin) {
    static_assert(sizeof(SpatialGaussian) == 10 * sizeof(float));
    Float4 of[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto* bytes = reinterpret_cast<const std::byte*>(four + i);
      std::memcpy(&of[i], bytes + begin * sizeof(float), sizeof of[i]);
    }
    return transposed(of[0], of[1], of[2], of[3]);
  }
};

Float8 both(const Float4& low, const Float4& high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

}  // namespace

WhitenedGroup::WhitenedGroup(std::span<const SpatialGaussian> components) {
  if (components.size() >= kLanes) {
    fill(components.data());
    return;
  }
  SpatialGaussian eight[kLanes];
  std::fill_n(eight, kLanes, components[0]);
  for (SpatialGaussian& missing : std::span(eight).subspan(components.size())) missing.weight = 0;
  std::copy(components.begin(), components.end(), eight);
  fill(eight);
}

void WhitenedGroup::fill(const SpatialGaussian* eight) {
  const Components4 a(eight), b(eight + 4);
  weight = both(a.first.rows[0], b.first.rows[0]);
  mean = {both(a.first.rows[1], b.first.rows[1]), both(a.first.rows[2], b.first.rows[2]),
          both(a.first.rows[3], b.first.rows[3])};
  // In double precision, because terms of off-diagonal entries may nearly cancel.
  const Double8 l00 = widened(both(a.second.rows[0], b.second.rows[0]));
  const Double8 l10 = widened(both(a.second.rows[1], b.second.rows[1]));
  const Double8 l11 = widened(both(a.second.rows[2], b.second.rows[2]));
  const Double8 l20 = widened(both(a.second.rows[3], b.second.rows[3]));
  const Double8 l21 = widened(both(a.last.rows[2], b.last.rows[2]));
  const Double8 l22 = widened(both(a.last.rows[3], b.last.rows[3]));
  const Double8 over_area = all_doubles8(1) / (l11 * l22);
  const Double8 over_l11 = over_area * l22;
  whitening = {.r10 = rounded(-l10 * over_l11),
               .r11 = rounded(l00 * over_l11),
               .r20 = rounded((l10 * l21 - l20 * l11) * over_area),
               .r21 = rounded(-l21 * l00 * over_area),
               .r22 = rounded(l00 * over_area * l11)};
  constexpr double kOverTwoPi = 0.15915494309189535;
  over_l00 = rounded(all_doubles8(1) / l00);
  flatness = rounded(all_doubles8(kOverTwoPi) * l00 * l00 * over_area);
}

}  // namespace pharos
