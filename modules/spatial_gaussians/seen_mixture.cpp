#include "seen_mixture.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/warp.h>
#include <pharos/guiding/toolkit/lobe_products.h>
#include <pharos/guiding/toolkit/ray_integrals.h>

namespace pharos::spatial_gaussians {
namespace {

constexpr std::size_t kGroup = WhitenedGroup::kLanes;

Float8 cosine_factor(const FactorRule& rule, const SeenGroup& group) {
  const Float8 cosine = dot(group.aim, all8(rule.normal));
  return larger(rule.both_sides ? absolute(cosine) : cosine, all8(rule.least));
}

/// Returns the concentration of the von Mises-Fisher lobe that resembles the directions to a
/// Gaussian: the squared distance of the mean over the mean variance across the line of sight.
float concentration_of(const SpatialGaussian& g, Point3 origin) {
  const float* l = g.cholesky;
  const Vec3 mu = g.mean - origin;
  const float squared = length_squared(mu);
  if (!(squared > 0)) return von_mises_fisher::kLeastKappa;
  const float trace =
      square(l[0]) + square(l[1]) + square(l[2]) + square(l[3]) + square(l[4]) + square(l[5]);
  const Vec3 turned{l[0] * mu.x + l[1] * mu.y + l[3] * mu.z, l[2] * mu.y + l[4] * mu.z,
                    l[5] * mu.z};
  const float across = 0.5f * (trace - length_squared(turned) / squared);
  constexpr float kMostKappa = 1e6f;
  return across * kMostKappa > squared ? std::max(squared / across, von_mises_fisher::kLeastKappa)
                                       : kMostKappa;
}

/// Returns the integrals of the components' directions times the lobes, relative to scattering that
/// is the same in all directions.
Float8 scattering_factor(const FactorRule& rule, std::span<const SpatialGaussian> components,
                         Point3 origin, const SeenGroup& group) {
  Float8 kappa = all8(1);
  for (std::size_t i = 0; i < std::min(components.size(), kGroup); ++i) {
    kappa[i] = concentration_of(components[i], origin);
  }
  const Float8 mode = mode_density8(kappa);
  Float8 factor{};
  float total = 0;  // integral of the lobes over all directions
  for (const ScatteringLobe& lobe : rule.lobes) {
    factor += multiply(group.aim, kappa, mode, lobe).integral;
    total += lobe.peak / static_cast<float>(von_mises_fisher::mode_density(lobe.kappa));
  }
  return larger(factor * (1 / (total * warp::sphere_pdf())), all8(rule.least));
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

/// Prepares eight components for the origin.
void see_group(const WhitenedGroup& c, Point3 origin, const FactorRule& rule, Technique technique,
               SeenGroup& group) {
  const Lanes3<Double8> mu{widened(c.mean.x) - all_doubles8(origin.x),
                           widened(c.mean.y) - all_doubles8(origin.y),
                           widened(c.mean.z) - all_doubles8(origin.z)};
  const WhitenedMeans8 m(widened(c.whitening)(mu));
  group.whitening = c.whitening;
  group.towards = m.direction;
  const Float8 over_distance = aim_at(mu, technique, group);
  const Mask8 is_outside = over_distance > 0;
  group.ahead = m.length * over_distance;
  group.share = c.weight;
  if (rule.normal != Vec3{}) group.share *= cosine_factor(rule, group);
  if (technique == Technique::plane) {
    // d^2 / (2 pi sqrt|S|) with sqrt|S| = |L| |L^-1 mu| / d. If the origin is the mean itself,
    // there is no plane.
    const Float8 d = is_outside ? 1 / over_distance : Float8{};
    group.reach = d * c.over_l00;
    const Float8 cubed = group.reach * group.reach * d * c.flatness;
    group.weight = is_outside ? cubed / m.length : Float8{};
    group.share = is_outside ? group.share : Float8{};
  } else {
    group.weight = c.flatness;
    group.reach = m.length * c.over_l00;
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
                                     const FactorRule& rule, Technique technique, Arena& arena,
                                     std::span<const WhitenedGroup> whitened) {
  const std::size_t count = (components.size() + kGroup - 1) / kGroup;
  SeenGroup* groups = arena.make_array<SeenGroup>(count);
  float total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (whitened.empty()) {
      see_group(WhitenedGroup(components.subspan(i * kGroup)), origin, rule, technique, groups[i]);
    } else {
      see_group(whitened[i], origin, rule, technique, groups[i]);
    }
    if (!rule.lobes.empty()) {
      groups[i].share *= scattering_factor(rule, components.subspan(i * kGroup), origin, groups[i]);
    }
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
