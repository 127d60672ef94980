#include "seen_mixture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <pharos/core/lanes3.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/toolkit/ray_integrals.h>

namespace pharos::spatial_gaussians {
namespace {

constexpr std::size_t kGroup = 8;
constexpr double kOverTwoPi = 0.15915494309189535;

Double8 scaled(double factor, const Double8& x) {
  return all_doubles8(factor) * x;
}

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

/// Eight components as a structure of arrays. Missing ones are unit balls of weight zero beside the
/// origin.
struct Components8 {
  Components8(std::span<const SpatialGaussian> components, Point3 origin) {
    if (components.size() >= kGroup) {
      read(components.data(), origin);
      return;
    }
    SpatialGaussian eight[kGroup];
    std::fill_n(eight, kGroup, SpatialGaussian{0, origin + Vec3{1, 0, 0}, {1, 0, 1, 0, 0, 1}});
    std::copy(components.begin(), components.end(), eight);
    read(eight, origin);
  }
  Double8 weight;
  Lanes3<Double8> mu;  ///< mean, relative to the origin
  Double8 l00, l10, l11, l20, l21, l22;

 private:
  void read(const SpatialGaussian* eight, Point3 origin) {
    const Components4 a(eight), b(eight + 4);
    const auto both = [](const Float4& low, const Float4& high) {
      return widened(__builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7));
    };
    weight = both(a.first.rows[0], b.first.rows[0]);
    mu.x = both(a.first.rows[1], b.first.rows[1]) - all_doubles8(origin.x);
    mu.y = both(a.first.rows[2], b.first.rows[2]) - all_doubles8(origin.y);
    mu.z = both(a.first.rows[3], b.first.rows[3]) - all_doubles8(origin.z);
    l00 = both(a.second.rows[0], b.second.rows[0]);
    l10 = both(a.second.rows[1], b.second.rows[1]);
    l11 = both(a.second.rows[2], b.second.rows[2]);
    l20 = both(a.second.rows[3], b.second.rows[3]);
    l21 = both(a.last.rows[2], b.last.rows[2]);
    l22 = both(a.last.rows[3], b.last.rows[3]);
  }
};

/// Returns l00 L^-1 in double precision, because terms of off-diagonal entries may nearly cancel.
Whitening8<Double8> whitening_of(const Components8& c, const Double8& over_determinant) {
  const Double8 over_l11 = over_determinant * c.l22;
  return {.r10 = -c.l10 * over_l11,
          .r11 = c.l00 * over_l11,
          .r20 = (c.l10 * c.l21 - c.l20 * c.l11) * over_determinant,
          .r21 = -c.l21 * c.l00 * over_determinant,
          .r22 = c.l00 * over_determinant * c.l11};
}

Whitening8<Float8> rounded_whitening(const Whitening8<Double8>& w) {
  return {rounded(w.r10), rounded(w.r11), rounded(w.r20), rounded(w.r21), rounded(w.r22)};
}

Float8 cosine_factor(const CosineRule& rule, const SeenGroup& group) {
  const Float8 cosine = dot(group.aim, all8(rule.normal));
  return larger(rule.both_sides ? absolute(cosine) : cosine, all8(rule.least));
}

/// Sets the aims, the directions to the means, and returns the reciprocal distances of the means, 0
/// for distance 0. The length of an aim may be off by a rounding error, but its direction is exact
/// to twice the precision.
Float8 aim_at(const Lanes3<Double8>& mu, Technique technique, SeenGroup& group) {
  const Lanes3<Float8> near{rounded(mu.x), rounded(mu.y), rounded(mu.z)};
  const Float8 squared = dot(near, near);
  const Float8 over = squared > 0 ? 1 / sqrt(squared) : Float8{};
  const Lanes3<Double8> aim = widened(over) * mu;
  group.aim = {rounded(aim.x), rounded(aim.y), rounded(aim.z)};
  group.aim_rest = {rounded(aim.x - widened(group.aim.x)), rounded(aim.y - widened(group.aim.y)),
                    rounded(aim.z - widened(group.aim.z))};
  if (technique == Technique::plane) {
    group.wide_aim[0] = aim.x;
    group.wide_aim[1] = aim.y;
    group.wide_aim[2] = aim.z;
  }
  return over;
}

/// The means in whitened space: their lengths times l00, and their directions. The direction of a
/// zero mean is the x axis.
struct WhitenedMeans8 {
  explicit WhitenedMeans8(const Lanes3<Double8>& m) : length(sqrt(rounded(dot(m, m)))) {
    const Mask8 any = length > 0;
    const Float8 over = any ? 1 / length : Float8{};
    direction = {any ? rounded(m.x) * over : all8(1), rounded(m.y) * over, rounded(m.z) * over};
  }
  Float8 length;
  Lanes3<Float8> direction;
};

/// Prepares up to eight components for the origin.
void see_group(std::span<const SpatialGaussian> components, Point3 origin, const CosineRule& rule,
               Technique technique, SeenGroup& group) {
  const Components8 c(components, origin);
  const Double8 over_determinant = all_doubles8(1) / (c.l11 * c.l22);
  const Whitening8<Double8> exact_whitening = whitening_of(c, over_determinant);
  const WhitenedMeans8 m(exact_whitening(c.mu));
  group.whitening = rounded_whitening(exact_whitening);
  group.towards = m.direction;
  const Float8 over_distance = aim_at(c.mu, technique, group);
  const Mask8 is_outside = over_distance > 0;
  group.ahead = m.length * over_distance;
  group.share = rounded(c.weight);
  if (rule.normal != Vec3{}) group.share *= cosine_factor(rule, group);
  if (technique == Technique::plane) {
    // d^2 / (2 pi sqrt|S|) with sqrt|S| = |L| |L^-1 mu| / d. If the origin is the mean itself,
    // there is no plane.
    const Float8 d = is_outside ? 1 / over_distance : Float8{};
    const Float8 cubed = d * d * d * rounded(scaled(kOverTwoPi, over_determinant));
    group.weight = is_outside ? cubed / m.length : Float8{};
    group.share = is_outside ? group.share : Float8{};
    group.reach = d / rounded(c.l00);
  } else {
    group.weight = rounded(scaled(kOverTwoPi, c.l00 * c.l00 * over_determinant));
    group.reach = m.length / rounded(c.l00);
  }
  // If the origin is the mean itself, nothing is flipped: each direction gets half of its line.
  if (technique == Technique::flipped) {
    group.weight = is_outside ? group.weight : 0.5f * group.weight;
  }
  group.far = exp(-0.5f * group.reach * group.reach);
}

/// Returns the cosines between the means and a direction, in double precision: they are cubed, so
/// their relative errors near the horizon matter.
Float8 exact_cosine(const SeenGroup& group, Vec3 direction) {
  const Double8* aim = group.wide_aim;
  return rounded(aim[0] * all_doubles8(direction.x) + aim[1] * all_doubles8(direction.y) +
                 aim[2] * all_doubles8(direction.z));
}

/// Returns the densities of eight components, times their shares.
template <Technique technique>
Float8 densities(const SeenGroup& group, Vec3 direction) {
  // Differences from the aims; exact if they are small.
  const Lanes3<Float8> off = (all8(direction) - group.aim) - group.aim_rest;
  const Lanes3<Float8> white = group.whitening(off);
  // The part of the whitened direction that is perpendicular to the whitened mean. The aim has no
  // such part.
  const Lanes3<Float8> moment = cross(white, group.towards);
  const Float8 across = dot(moment, moment);
  // The exponent to base 2: -log2(e) / 2 times the squared distance.
  const Float8 miss = group.reach * group.reach * (-0.5f * kLog2E) * across;
  if constexpr (technique == Technique::plane) {
    const Float8 x = exact_cosine(group, direction);
    constexpr float kLeast = 1e-10f;  // its cube is still in the range of floats
    const Float8 over = 1 / larger(x, all8(kLeast));
    // The order of factors matters: their product without the exponential may overflow floats.
    const Float8 value = group.weight * exp2(miss * (over * over));
    return x > kLeast ? value * over * over * over : Float8{};
  } else {
    const Float8 x = group.ahead + dot(group.towards, white);
    const Float8 a = x * x + across, over = 1 / a, over_root = over * sqrt(a);
    const Rays8 rays{group.reach * x * over_root, miss * over};
    const Float8 scale = group.weight * (over * over_root);
    if constexpr (technique == Technique::flipped) {
      return dot(group.aim, all8(direction)) < 0 ? Float8{} : scale * rays.line_integral();
    } else {
      // The components are so far away that rays that point away from them have density 0.
      if (!any(group.far > 0)) return x < 0 ? Float8{} : scale * rays.line_integral();
      return scale * rays.ray_integral(group.far);
    }
  }
}

template <Technique technique>
float density_of(std::span<const SeenGroup> groups, Vec3 direction) {
  Float8 total{};
  for (const SeenGroup& group : groups) total += densities<technique>(group, direction);
  return sum(total);
}

/// Returns three independent normal numbers for three uniform ones: two by Box and Muller's method,
/// one by the quantile function.
Vec3 normal_numbers(Vec2 u, float v) {
  const warp::ConcentricPoint p = warp::concentric_from_square(u);
  // r^2 is uniform. Computing 1 - r^2 as a product keeps the digits of large normal numbers.
  const float left = std::max((1 - p.radius) * (1 + p.radius), 0x1p-25f);
  const float radius = std::copysign(std::sqrt(-2 * std::log(left)), p.radius);
  return {radius * p.direction.x, radius * p.direction.y, warp::fast_normal_from_unit(v)};
}

}  // namespace

const SeenMixture* SeenMixture::make(std::span<const SpatialGaussian> components, Point3 origin,
                                     const CosineRule& rule, Technique technique, Arena& arena) {
  const std::size_t count = (components.size() + kGroup - 1) / kGroup;
  SeenGroup* groups = arena.make_array<SeenGroup>(count);
  float total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    see_group(components.subspan(i * kGroup, std::min(kGroup, components.size() - i * kGroup)),
              origin, rule, technique, groups[i]);
    total += sum(groups[i].share);
  }
  if (!(total > 0)) return nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    groups[i].share *= 1 / total;
    groups[i].weight *= groups[i].share;
  }
  return arena.make<SeenMixture>(components, origin, std::span<const SeenGroup>(groups, count),
                                 technique);
}

float SeenMixture::density(Vec3 direction) const {
  switch (technique_) {
    case Technique::exact:
      return density_of<Technique::exact>(groups_, direction);
    case Technique::flipped:
      return density_of<Technique::flipped>(groups_, direction);
    default:
      return density_of<Technique::plane>(groups_, direction);
  }
}

std::optional<Vec3> SeenMixture::sample(float choice, Vec2 u, float v) const {
  std::size_t chosen = 0;
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const float share = groups_[k / kGroup].share[k % kGroup];
    if (!(share > 0)) continue;
    chosen = k;  // the last one with a share, if rounding leaves a rest of `choice`
    if (choice < share) break;
    choice -= share;
  }
  const SpatialGaussian& g = components_[chosen];
  const Vec3 aim = g.mean - origin_;
  Vec3 point = spread(g, normal_numbers(u, v));
  if (technique_ == Technique::plane) {
    const Vec3 n = normalize(aim);
    point = point - dot(n, point) * n;
  }
  point = point + aim;
  const float squared = length_squared(point);
  if (!(squared > 0)) return std::nullopt;
  const Vec3 direction = point / std::sqrt(squared);
  const bool turns = technique_ == Technique::flipped && dot(direction, aim) < 0;
  return turns ? -direction : direction;
}

}  // namespace pharos::spatial_gaussians
