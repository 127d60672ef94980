#include "lathe_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/core.h>

#include <pharos/core/error.h>

namespace pharos {
namespace {

float length(Vec2 v) {
  return std::hypot(v.x, v.y);
}

bool is_closed(const std::vector<Vec2>& points) {
  return points.front() == points.back();
}

/// Returns the mirror image of a point on the other side of the axis.
Vec2 mirrored(Vec2 p) {
  return {-p.x, p.y};
}

/// Returns the point that continues a profile beyond its end.
Vec2 reflected(Vec2 end, Vec2 neighbor) {
  return end.x == 0 ? mirrored(neighbor) : 2 * end - neighbor;
}

/// Adds one point before the first and one after the last, which define the curvature of the first
/// and last piece.
std::vector<Vec2> with_neighbors(const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  const bool closed = is_closed(points);
  std::vector<Vec2> all{closed ? points[n - 2] : reflected(points[0], points[1])};
  all.insert(all.end(), points.begin(), points.end());
  all.push_back(closed ? points[1] : reflected(points[n - 1], points[n - 2]));
  return all;
}

/// Returns the point of the spline between p[1] and p[2] at `s` in [0, 1], by the pyramid of linear
/// interpolations of Barry and Goldman. The knots are sums of distances to the power 1/2.
Vec2 centripetal_point(const Vec2* p, float s) {
  float knots[4] = {};
  for (int i = 0; i < 3; ++i) knots[i + 1] = knots[i] + std::sqrt(length(p[i + 1] - p[i]));
  const float t = lerp(knots[1], knots[2], s);
  Vec2 level[4] = {p[0], p[1], p[2], p[3]};
  const auto blend = [&](int i, int left, int right) {
    const float w = (t - knots[left]) / (knots[right] - knots[left]);
    level[i] = (1 - w) * level[i] + w * level[i + 1];
  };
  for (int i = 0; i < 3; ++i) blend(i, i, i + 1);
  for (int i = 0; i < 2; ++i) blend(i, i, i + 2);
  blend(0, 1, 2);
  return level[0];
}

/// Returns the normal to the right of a piece from a to b.
Vec2 normal_of(Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  return 1 / length(along) * Vec2{along.y, -along.x};
}

/// Returns the normal of the piece from a to b at the end where it meets `neighbor`, the far end of
/// the next or the previous piece. The weights of both normals are the inverse lengths of the
/// pieces, which is exact to second order for points on a smooth curve.
Vec2 joint_normal(Vec2 a, Vec2 b, Vec2 joint, Vec2 neighbor, float least_cosine) {
  const Vec2 own = normal_of(a, b);
  const Vec2 other = joint == b ? normal_of(b, neighbor) : normal_of(neighbor, a);
  if (own.x * other.x + own.y * other.y < least_cosine) return own;
  const Vec2 sum = 1 / length(b - a) * own + 1 / length(neighbor - joint) * other;
  const float size = length(sum);
  return size > 0 ? 1 / size * sum : own;
}

}  // namespace

void check_profile(const std::vector<Vec2>& points) {
  if (points.size() < 2) throw InputError("lathe: 'profile' needs at least two points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x < 0) {
      throw InputError(fmt::format("lathe: point {} of 'profile' has a negative r", i));
    }
    if (i > 0 && points[i] == points[i - 1]) {
      throw InputError(fmt::format("lathe: point {} of 'profile' repeats the one before", i));
    }
  }
  if (is_closed(points) && points.size() < 4) {
    throw InputError("lathe: a closed 'profile' needs at least three different points");
  }
}

std::vector<Vec2> catmull_rom(const std::vector<Vec2>& points, int subdivisions) {
  const std::vector<Vec2> all = with_neighbors(points);
  std::vector<Vec2> curve{points.front()};
  const auto append = [&](Vec2 p) {  // omits points that are equal after rounding
    if (p != curve.back()) curve.push_back(p);
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    for (int k = 1; k < subdivisions; ++k) {
      const float s = static_cast<float>(k) / static_cast<float>(subdivisions);
      const Vec2 p = centripetal_point(&all[i], s);
      append({std::max(p.x, 0.0f), p.y});
    }
    append(points[i + 1]);
  }
  return curve;
}

std::vector<ProfilePiece> profile_pieces(const std::vector<Vec2>& points, float crease) {
  const std::vector<Vec2> all = with_neighbors(points);
  const float least_cosine = std::cos(radians(crease));
  std::vector<ProfilePiece> pieces;
  float whole = 0;
  for (std::size_t i = 1; i + 2 < all.size(); ++i) {
    const Vec2 a = all[i], b = all[i + 1];
    const float start = whole;
    whole += length(b - a);
    if (a.x == 0 && b.x == 0) continue;
    const Vec2 before = a.x == 0 ? mirrored(b) : all[i - 1];
    const Vec2 after = b.x == 0 ? mirrored(a) : all[i + 2];
    pieces.push_back({.from = a,
                      .to = b,
                      .normal_from = joint_normal(a, b, a, before, least_cosine),
                      .normal_to = joint_normal(a, b, b, after, least_cosine),
                      .v_from = start,
                      .v_to = whole});
  }
  for (ProfilePiece& p : pieces) {
    p.v_from /= whole;
    p.v_to /= whole;
  }
  return pieces;
}

}  // namespace pharos
