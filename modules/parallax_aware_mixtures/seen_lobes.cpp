#include "seen_lobes.h"

#include <pharos/guiding/toolkit/lobe_products.h>

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
  seen.mean = {is_apart ? x * over : lobes.mean[0], is_apart ? y * over : lobes.mean[1],
               is_apart ? z * over : lobes.mean[2]};
}

}  // namespace

const SeenLobes* SeenLobes::make(std::span<const LobeGroup> groups, Vec3 offset,
                                 std::span<const ScatteringLobe> factors, Arena& arena) {
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
      const LobeProducts product =
          multiply(seen[i].mean, lobes.kappa, lobes.mode, factors[i % copies]);
      seen[i].mean = product.mean;
      seen[i].share = lobes.weight * product.integral;
      seen[i].scale = product.mode;
      seen[i].kappa = product.kappa;
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
  return von_mises_fisher::sample(lane_of(g.mean, static_cast<unsigned>(lane)), g.kappa[lane], u);
}

}  // namespace pharos::parallax_aware_mixtures
