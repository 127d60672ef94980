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
  Double4 x, y, z;
};

Double4 dot4(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Double4 choose(const Mask4& mask, const Double4& a, const Double4& b) {
  return mask ? a : b;
}

/// Four components, number by number. Where there are no more, harmless ones without weight.
struct Components4 {
  Components4(std::span<const SpatialGaussian> components, std::size_t first, Point3 origin) {
    if (first + 4 <= components.size()) {
      read(&components[first], origin);
      return;
    }
    SpatialGaussian four[4];
    std::fill_n(four, 4, SpatialGaussian{0, origin + Vec3{1, 0, 0}, {1, 0, 1, 0, 0, 1}});
    for (std::size_t i = first; i < components.size(); ++i) four[i - first] = components[i];
    read(four, origin);
  }
  Double4 weight;
  Lanes3 mu;     ///< mean, from the origin
  Double4 l[6];  ///< l00, l10, l11, l20, l21, l22

 private:
  void read(const SpatialGaussian* four, Point3 origin) {
    const Transposed4 first = numbers(four, 0), second = numbers(four, 4), last = numbers(four, 6);
    weight = widened(first.rows[0]);
    mu.x = widened(first.rows[1]) - double{origin.x};
    mu.y = widened(first.rows[2]) - double{origin.y};
    mu.z = widened(first.rows[3]) - double{origin.z};
    for (int k = 0; k < 4; ++k) l[k] = widened(second.rows[k]);
    l[4] = widened(last.rows[2]);
    l[5] = widened(last.rows[3]);
  }
  /// Numbers `begin` to `begin` + 3 of each component.
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

/// l00 L^-1, the lower triangle.
struct Whitening4 {
  explicit Whitening4(const Double4 (&l)[6]) : over_determinant(1 / (l[2] * l[5])) {
    const Double4 over11 = over_determinant * l[5];
    r10 = -l[1] * over11;
    r11 = l[0] * over11;
    r20 = (l[1] * l[4] - l[3] * l[2]) * over_determinant;
    r21 = -l[4] * l[0] * over_determinant;
    r22 = l[0] * over_determinant * l[2];
  }
  Lanes3 operator()(const Lanes3& v) const {
    return {v.x, r10 * v.x + r11 * v.y, r20 * v.x + r21 * v.y + r22 * v.z};
  }
  /// The row vector v^T l00 L^-1.
  Lanes3 row(const Lanes3& v) const {
    return {v.x + v.y * r10 + v.z * r20, v.y * r11 + v.z * r21, v.z * r22};
  }
  Double4 over_determinant;  ///< 1 / (l11 l22)
  Double4 r10, r11, r20, r21, r22;
};

/// Two unit vectors that are perpendicular to a third and to each other (Duff et al. 2017).
std::array<Lanes3, 2> perpendicular(const Lanes3& n) {
  const Double4 sign = choose(n.z < 0, all4(-1), all4(1));
  const Double4 a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {Lanes3{1 + sign * n.x * n.x * a, sign * b, -sign * n.x},
          Lanes3{b, sign + n.y * n.y * a, -n.y}};
}

/// A vector's length and direction: the x axis where it is 0.
struct Polar4 {
  explicit Polar4(const Lanes3& v) : length(sqrt(dot4(v, v))) {
    const Mask4 none = length == 0;
    const Double4 over = 1 / choose(none, all4(1), length);
    direction = {choose(none, all4(1), v.x * over), v.y * over, v.z * over};
  }
  Double4 length;
  Lanes3 direction;
};

void set_row(SeenGroup& group, int row, int half, const Lanes3& values) {
  group.rows[row][0][half] = values.x;
  group.rows[row][1][half] = values.y;
  group.rows[row][2][half] = values.z;
}

Double4 cosine_factor(const CosineRule& rule, const Lanes3& aim) {
  const Double4 cosine =
      aim.x * double{rule.normal.x} + aim.y * double{rule.normal.y} + aim.z * double{rule.normal.z};
  const Double4 counted = rule.both_sides ? larger(cosine, -cosine) : cosine;
  return larger(counted, all4(rule.least));
}

/// What becomes of four components; the numbers that are single in the group come as double here.
struct Seen4 {
  Lanes3 aim;
  Double4 share, weight, reach;
};

Seen4 see(SeenGroup& group, int half, const Components4& c, const CosineRule& rule,
          Technique technique) {
  const Whitening4 whitening(c.l);
  const Polar4 m(whitening(c.mu)), mu(c.mu);  // the former times l00
  const std::array<Lanes3, 2> across = perpendicular(m.direction);
  const Mask4 is_inside = mu.length == 0;
  Seen4 seen;
  seen.aim = mu.direction;
  set_row(group, 0, half, technique == Technique::plane ? seen.aim : whitening.row(m.direction));
  set_row(group, 1, half, whitening.row(across[0]));
  set_row(group, 2, half, whitening.row(across[1]));
  seen.share = c.weight;
  const bool weighs = rule.normal != Vec3{};
  if (weighs) seen.share *= choose(is_inside, all4(rule.least), cosine_factor(rule, seen.aim));
  const Double4 over00 = 1 / c.l[0];
  if (technique == Technique::plane) {
    // d^2 / (2 pi sqrt|S|), sqrt|S| = |L| |L^-1 mu| / d.
    const Double4 d = mu.length;
    seen.share = choose(is_inside, Double4{}, seen.share);
    seen.reach = d * over00;
    seen.weight = choose(is_inside, Double4{},
                         kOverTwoPi * d * d * d * whitening.over_determinant / m.length);
  } else {
    seen.reach = m.length * over00;
    seen.weight = kOverTwoPi * c.l[0] * c.l[0] * whitening.over_determinant;
  }
  // Nothing is turned around in the mean itself: half of each line.
  if (technique == Technique::flipped) {
    seen.weight = choose(is_inside, 0.5 * seen.weight, seen.weight);
    for (Double4* v : {&seen.aim.x, &seen.aim.y, &seen.aim.z})
      *v = choose(is_inside, Double4{}, *v);
  }
  return seen;
}

void see_group(std::span<const SpatialGaussian> components, std::size_t first, Point3 origin,
               const CosineRule& rule, Technique technique, SeenGroup& group) {
  const Seen4 low = see(group, 0, {components, first, origin}, rule, technique);
  const Seen4 high = see(group, 1, {components, first + 4, origin}, rule, technique);
  group.share = rounded(low.share, high.share);
  group.weight = rounded(low.weight, high.weight);
  group.reach = rounded(low.reach, high.reach);
  group.far = exp(-0.5f * group.reach * group.reach);
  group.aim[0] = rounded(low.aim.x, high.aim.x);
  group.aim[1] = rounded(low.aim.y, high.aim.y);
  group.aim[2] = rounded(low.aim.z, high.aim.z);
}

Float8 row_times(const SeenGroup& group, int row, const Double4 (&direction)[3]) {
  const auto& r = group.rows[row];
  Double4 halves[2];
  for (int half = 0; half < 2; ++half) {
    halves[half] =
        r[0][half] * direction[0] + r[1][half] * direction[1] + r[2][half] * direction[2];
  }
  return rounded(halves[0], halves[1]);
}

/// The densities of eight components, times their shares.
template <Technique technique>
Float8 densities(const SeenGroup& group, Vec3 direction, const Double4 (&wide)[3]) {
  const Float8 x = row_times(group, 0, wide);
  const Float8 y = row_times(group, 1, wide), z = row_times(group, 2, wide);
  const Float8 across = y * y + z * z;
  // -log2(e) / 2 times the squared distance: what the exponent has.
  const Float8 miss = group.reach * group.reach * (-0.5f * kLog2E) * across;
  if constexpr (technique == Technique::plane) {
    constexpr float kLeast = 1e-10f;  // so that its cube is a float
    const Float8 over = 1 / larger(x, all8(kLeast));
    const Float8 scale = group.weight * (over * over * over);
    return x > kLeast ? scale * exp2(miss * (over * over)) : Float8{};
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
  const Double4 wide[3] = {all4(direction.x), all4(direction.y), all4(direction.z)};
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
    see_group(components, i * kGroup, origin, rule, technique, groups[i]);
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
  const Vec3 z = normal_numbers(u, v), aim = g.mean - origin_;
  const float* l = g.cholesky;
  Vec3 point{l[0] * z.x, l[1] * z.x + l[2] * z.y, l[3] * z.x + l[4] * z.y + l[5] * z.z};
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
