#include "seen_lobes.h"

#include "vmf.h"

namespace pharos::parallax_aware_mixtures {
namespace {

/// Sets the lobes' directions as seen from the vertex: mu r + offset, normalized, where r is the
/// distance.
void shift(const LobeGroup& lobes, Vec3 offset, SeenGroup& seen) {
  const Float8& inverse = lobes.inverse_distance;
  const Float8 x = lobes.mean[0] + inverse * offset.x, y = lobes.mean[1] + inverse * offset.y,
               z = lobes.mean[2] + inverse * offset.z;
  const Float8 squared = x * x + y * y + z * z;
  constexpr float kLeast = 1e-12f;  // nearer to the light, the direction stays unchanged
  const Mask8 is_apart = squared > kLeast;
  const Float8 over = 1 / sqrt(larger(squared, all8(kLeast)));
  seen.mean[0] = is_apart ? x * over : lobes.mean[0];
  seen.mean[1] = is_apart ? y * over : lobes.mean[1];
  seen.mean[2] = is_apart ? z * over : lobes.mean[2];
}

/// Returns the density at the mean for kappa >= kLeastKappa [1/sr]. For flat lobes it uses the
/// series, because the difference in the formula would lose digits.
Float8 mode_density8(const Float8& kappa) {
  constexpr float kOverTwoPi = 0.159154943f, kFlat = 0.1f;
  const Float8 flat = 0.5f * kOverTwoPi * (1 + kappa * (1 + (1.0f / 3) * kappa));
  return kappa < kFlat ? flat : kappa * kOverTwoPi / (1 - exp(-2 * kappa));
}

/// Multiplies the lobes by another lobe: kappa' mu' = kappa mu + kappa_f mu_f. The weight changes
/// by the quotient of the densities at the means, and by e^(kappa' - kappa - kappa_f). This
/// exponent equals -kappa kappa_f |mu - mu_f|^2 / (kappa' + kappa + kappa_f).
void multiply(const LobeGroup& lobes, const Factor& factor, SeenGroup& seen) {
  const Float8& kappa = lobes.kappa;
  const Vec3 f = factor.kappa * factor.mean;
  const Float8 apart = squared_distance(seen.mean, factor.mean);
  const Float8 x = kappa * seen.mean[0] + f.x, y = kappa * seen.mean[1] + f.y,
               z = kappa * seen.mean[2] + f.z;
  const Float8 length = sqrt(x * x + y * y + z * z);
  const Float8 product = larger(length, all8(kLeastKappa)), over = 1 / product;
  const Float8 exponent = -kappa * factor.kappa * apart / (product + kappa + factor.kappa);
  const Float8 mode = mode_density8(product);
  seen.share = lobes.weight * factor.peak * (lobes.mode / mode) * exp(exponent);
  seen.scale = mode;
  seen.kappa = product;
  // The product of opposite lobes of the same concentration is a flat lobe.
  const Mask8 is_flat = length < kLeastKappa;
  seen.mean[0] = is_flat ? seen.mean[0] : x * over;
  seen.mean[1] = is_flat ? seen.mean[1] : y * over;
  seen.mean[2] = is_flat ? seen.mean[2] : z * over;
}

}  // namespace

const SeenLobes* SeenLobes::make(std::span<const LobeGroup> groups, Vec3 offset,
                                 std::span<const Factor> factors, Arena& arena) {
  const std::size_t copies = factors.empty() ? 1 : factors.size();
  const std::size_t count = groups.size() * copies;
  SeenGroup* seen = arena.make_array<SeenGroup>(count);
  Float8 sums{};
  for (std::size_t i = 0; i < count; ++i) {
    const LobeGroup& lobes = groups[i / copies];
    shift(lobes, offset, seen[i]);
    if (factors.empty()) {
      seen[i].share = lobes.weight;
      seen[i].scale = lobes.mode;
      seen[i].kappa = lobes.kappa;
    } else {
      multiply(lobes, factors[i % copies], seen[i]);
    }
    seen[i].slope = (-0.5f * kLog2E) * seen[i].kappa;
    sums += seen[i].share;
  }
  const float total = sum(sums);
  // One over a smaller sum may be infinite.
  constexpr float kLeastTotal = 1e-30f;
  if (!(total > kLeastTotal)) return nullptr;
  const float over = 1 / total;
  for (std::size_t i = 0; i < count; ++i) {
    seen[i].share *= over;
    seen[i].scale *= seen[i].share;
  }
  return arena.make<SeenLobes>(std::span<const SeenGroup>(seen, count));
}

float SeenLobes::density(Vec3 direction) const {
  Float8 total{};
  for (const SeenGroup& g : groups_) {
    total += g.scale * exp2(g.slope * squared_distance(g.mean, direction));
  }
  return sum(total);
}

Vec3 SeenLobes::sample(float choice, Vec2 u) const {
  // Takes the last lobe with a share if rounding leaves a rest of `choice`.
  std::size_t group = 0, lane = 0;
  for (std::size_t k = 0; k < groups_.size() * kLanes; ++k) {
    const float share = groups_[k / kLanes].share[k % kLanes];
    if (!(share > 0)) continue;
    group = k / kLanes;
    lane = k % kLanes;
    if (choice < share) break;
    choice -= share;
  }
  const SeenGroup& g = groups_[group];
  return parallax_aware_mixtures::sample({g.mean[0][lane], g.mean[1][lane], g.mean[2][lane]},
                                         g.kappa[lane], u);
}

}  // namespace pharos::parallax_aware_mixtures
