#include "seen_mixture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <pharos/core/warp.h>

#include "ray_integrals.h"

namespace pharos::gaussians {
namespace {

constexpr std::size_t kGroup = 8;
constexpr double kOverTwoPi = 0.15915494309189535;

struct Lanes3 {
  Double8 x, y, z;
};

Double8 dot8(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Double8 scaled(double factor, const Double8& x) {
  return all_doubles8(factor) * x;
}

/// Four components, number by number.
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

/// Eight components, number by number. Where there are no more, harmless ones without weight.
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
  Lanes3 mu;  ///< mean, from the origin
  Double8 l00, l10, l11, l20, l21, l22;

 private:
  void read(const SpatialGaussian* eight, Point3 origin) {
    const Components4 a(eight), b(eight + 4);
    const auto both = [](const Float4& low, const Float4& high) {
      return Double8{widened(low), widened(high)};
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

/// l00 L^-1, the lower triangle.
struct Whitening8 {
  explicit Whitening8(const Components8& c)
      : over_determinant(all_doubles8(1) / (c.l11 * c.l22)),
        r10(-c.l10 * (over_determinant * c.l22)),
        r11(c.l00 * (over_determinant * c.l22)),
        r20((c.l10 * c.l21 - c.l20 * c.l11) * over_determinant),
        r21(-c.l21 * c.l00 * over_determinant),
        r22(c.l00 * over_determinant * c.l11) {}

  Lanes3 operator()(const Lanes3& v) const {
    return {v.x, r10 * v.x + r11 * v.y, r20 * v.x + r21 * v.y + r22 * v.z};
  }
  /// The row vector v^T l00 L^-1.
  Lanes3 row(const Lanes3& v) const {
    return {v.x + v.y * r10 + v.z * r20, v.y * r11 + v.z * r21, v.z * r22};
  }
  Double8 over_determinant;  ///< 1 / (l11 l22)
  Double8 r10, r11, r20, r21, r22;
};

/// Two unit vectors that are perpendicular to a third and to each other (Duff et al. 2017).
std::array<Lanes3, 2> perpendicular(const Lanes3& n) {
  const Double8 one = all_doubles8(1), sign = choose(is_negative(n.z), -one, one);
  const Double8 a = -one / (sign + n.z), b = n.x * n.y * a;
  return {Lanes3{one + sign * n.x * n.x * a, sign * b, -sign * n.x},
          Lanes3{b, sign + n.y * n.y * a, -n.y}};
}

/// A vector's length and direction: the x axis where it is 0.
struct Polar8 {
  explicit Polar8(const Lanes3& v) : length(sqrt(dot8(v, v))) {
    const DoubleMask8 none = is_zero(length);
    const Double8 one = all_doubles8(1), over = one / choose(none, one, length);
    direction = {choose(none, one, v.x * over), v.y * over, v.z * over};
  }
  Double8 length;
  Lanes3 direction;
};

void set_row(SeenGroup& group, int row, const Lanes3& values) {
  group.rows[row][0] = values.x;
  group.rows[row][1] = values.y;
  group.rows[row][2] = values.z;
}

Float8 cosine_factor(const CosineRule& rule, const SeenGroup& group) {
  const Float8 cosine =
      group.aim[0] * rule.normal.x + group.aim[1] * rule.normal.y + group.aim[2] * rule.normal.z;
  return larger(rule.both_sides ? absolute(cosine) : cosine, all8(rule.least));
}

/// Distance and direction of the means in single precision, where nothing is left to cancel.
Float8 aim_at(const Lanes3& mu, SeenGroup& group) {
  const Float8 x = rounded(mu.x), y = rounded(mu.y), z = rounded(mu.z);
  const Float8 distance = sqrt(x * x + y * y + z * z);
  const Float8 over = distance > 0 ? 1 / distance : Float8{};
  group.aim[0] = x * over;
  group.aim[1] = y * over;
  group.aim[2] = z * over;
  return distance;
}

/// What `plane` has of its own: the direction to the mean in place of the first axis, and its
/// density's factors. There is no plane in the mean itself.
void see_plane(const Components8& c, const Whitening8& whitening, const Double8& reach,
               SeenGroup& group) {
  const Polar8 mu(c.mu);
  set_row(group, 0, mu.direction);
  // d^2 / (2 pi sqrt|S|), sqrt|S| = |L| |L^-1 mu| / d.
  const Double8 d = mu.length, cubed = d * d * d * whitening.over_determinant;
  const DoubleMask8 inside = is_zero(reach);
  group.weight = rounded(choose(inside, Double8{}, scaled(kOverTwoPi, cubed) / reach));
  group.reach = rounded(d / c.l00);
}

/// What becomes of up to eight components.
void see_group(std::span<const SpatialGaussian> components, Point3 origin, const CosineRule& rule,
               Technique technique, SeenGroup& group) {
  const Components8 c(components, origin);
  const Whitening8 whitening(c);
  const Polar8 m(whitening(c.mu));  // times l00
  const std::array<Lanes3, 2> across = perpendicular(m.direction);
  set_row(group, 1, whitening.row(across[0]));
  set_row(group, 2, whitening.row(across[1]));
  const Float8 distance = aim_at(c.mu, group);
  group.share = rounded(c.weight);
  if (rule.normal != Vec3{}) group.share *= cosine_factor(rule, group);
  if (technique == Technique::plane) {
    see_plane(c, whitening, m.length, group);
    group.share = distance > 0 ? group.share : Float8{};
  } else {
    set_row(group, 0, whitening.row(m.direction));
    group.reach = rounded(m.length) / rounded(c.l00);
    group.weight = rounded(scaled(kOverTwoPi, c.l00 * c.l00 * whitening.over_determinant));
  }
  // Nothing is turned around in the mean itself: half of each line.
  if (technique == Technique::flipped) {
    group.weight = distance > 0 ? group.weight : 0.5f * group.weight;
  }
  group.far = exp(-0.5f * group.reach * group.reach);
}

Float8 row_times(const Double8 (&row)[3], const Double8 (&direction)[3]) {
  return rounded(row[0] * direction[0] + row[1] * direction[1] + row[2] * direction[2]);
}

/// The densities of eight components, times their shares.
template <Technique technique>
Float8 densities(const SeenGroup& group, Vec3 direction, const Double8 (&wide)[3]) {
  const Float8 x = row_times(group.rows[0], wide);
  const Float8 y = row_times(group.rows[1], wide), z = row_times(group.rows[2], wide);
  const Float8 across = y * y + z * z;
  // -log2(e) / 2 times the squared distance: what the exponent has.
  const Float8 miss = group.reach * group.reach * (-0.5f * kLog2E) * across;
  if constexpr (technique == Technique::plane) {
    constexpr float kLeast = 1e-10f;  // so that its cube is a float
    const Float8 over = 1 / larger(x, all8(kLeast));
    // (In this order, as the factors alone may be too large for floats.)
    const Float8 value = group.weight * exp2(miss * (over * over));
    return x > kLeast ? value * over * over * over : Float8{};
  } else {
    const Float8 a = x * x + across, over = 1 / a, root = sqrt(a), along = group.reach * x;
    const Rays8 rays{along, root, along * along * over, miss * over};
    const Float8 scale = group.weight * (over * over * root);  // a^(-3/2)
    if constexpr (technique == Technique::flipped) {
      const Float8 side =
          group.aim[0] * direction.x + group.aim[1] * direction.y + group.aim[2] * direction.z;
      return side < 0 ? Float8{} : scale * rays.line_integral();
    } else {
      // So far away that no ray that looks away meets anything.
      if (!any(group.far > 0)) return x < 0 ? Float8{} : scale * rays.line_integral();
      return scale * rays.ray_integral(group.far);
    }
  }
}

template <Technique technique>
float density_of(std::span<const SeenGroup> groups, Vec3 direction) {
  const Double8 wide[3] = {all_doubles8(direction.x), all_doubles8(direction.y),
                           all_doubles8(direction.z)};
  Float8 total{};
  for (const SeenGroup& group : groups) total += densities<technique>(group, direction, wide);
  return sum(total);
}

/// Three independent normal numbers from three uniform ones: Box and Muller's two, and a quantile.
Vec3 normal_numbers(Vec2 u, float v) {
  const warp::ConcentricPoint p = warp::concentric_from_square(u);
  // The disk's r^2 is uniform; 1 - r^2 by its factors keeps the digits of large numbers.
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
    chosen = k;  // the last one with a share, should rounding leave something of `choice`
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

}  // namespace pharos::gaussians
