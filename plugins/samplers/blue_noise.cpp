#include "blue_noise.h"

#include <algorithm>
#include <bit>
#include <span>

#include <pharos/core/random.h>

namespace pharos::pmj02 {
namespace {

/// The number of views that judge blocks, and the number of interval sizes tried for each block
/// size. With these values four sequences are prepared in a twentieth of a second.
constexpr int kViews = 8, kDepths = 3;

/// One way of using a block of points: `flips` are the flipped digits.
struct View {
  std::vector<Point> points;
  Point flips;
};

/// A half of an interval of x or of y, selected by its first `depth` digits.
struct Half {
  std::uint32_t Point::*axis;
  int depth;
  std::uint32_t parent;  ///< the first depth - 1 digits

  bool holds(const Point& p) const { return depth == 1 || (p.*axis) >> (33 - depth) == parent; }
  std::uint32_t digit() const { return 0x80000000u >> (depth - 1); }
};

/// Returns how much two of n points crowd each other on the torus. The value is at most 1,
/// decreases with the distance, and is 0 from a distance of n^-1/2 on.
float crowding(Point a, Point b, float count) {
  const float x = static_cast<float>(static_cast<std::int32_t>(a.x - b.x)) * 0x1p-32f;
  const float y = static_cast<float>(static_cast<std::int32_t>(a.y - b.y)) * 0x1p-32f;
  const float near = std::max(0.0f, 1 - (x * x + y * y) * count);
  return near * near * near * near;
}

float crowding(Point a, std::span<const Point> others, float count) {
  float sum = 0;
  for (const Point& b : others) sum += crowding(a, b, count);
  return sum;
}

/// Sums over the pairs of points with at least one point in the interval.
float crowding(const View& view, const Half& half) {
  const auto count = static_cast<float>(view.points.size());
  std::vector<Point> inside;
  for (const Point& p : view.points) {
    if (half.holds({p.x ^ view.flips.x, p.y ^ view.flips.y})) inside.push_back(p);
  }
  float sum = 0;
  for (const Point& p : inside) {
    sum += crowding(p, view.points, count) - crowding(p, inside, count) / 2;
  }
  return sum;
}

float crowding(const std::vector<View>& views, const Half& half) {
  float sum = 0;
  for (const View& v : views) sum += crowding(v, half);
  return sum;
}

void swap_halves(std::vector<View>& views, const Half& half) {
  for (View& v : views) {
    for (Point& p : v.points) {
      if (half.holds({p.x ^ v.flips.x, p.y ^ v.flips.y})) p.*half.axis ^= half.digit();
    }
  }
}

/// Draws views of blocks of `size` points.
std::vector<View> draw_views(const std::vector<Point>& points, std::size_t size,
                             RandomStream& random) {
  std::vector<View> views(kViews);
  for (View& v : views) {
    const std::size_t first = random() % (points.size() / size) * size;
    const std::uint64_t flips = random();
    v.flips = {static_cast<std::uint32_t>(flips >> 32), static_cast<std::uint32_t>(flips)};
    for (std::size_t i = first; i < first + size; ++i) {
      v.points.push_back({points[i].x ^ v.flips.x, points[i].y ^ v.flips.y});
    }
  }
  return views;
}

void try_swap(std::vector<Point>& points, std::vector<View>& views, const Half& half) {
  const float before = crowding(views, half);
  swap_halves(views, half);
  if (crowding(views, half) >= before) {
    swap_halves(views, half);
    return;
  }
  for (Point& p : points) {
    if (half.holds(p)) p.*half.axis ^= half.digit();
  }
}

}  // namespace

void move_apart(std::vector<Point>& points, std::uint64_t seed) {
  RandomStream random(seed);
  const int most = std::countr_zero(points.size());
  for (int k = 2; k <= most; ++k) {
    std::vector<View> views = draw_views(points, std::size_t{1} << k, random);
    // Points of the block are about 2^(-k/2) apart.
    const int first = k == 2 ? 1 : (k + 1) / 2 + 1;
    for (int depth = first; depth < (k + 1) / 2 + 1 + kDepths; ++depth) {
      for (std::uint32_t parent = 0; parent < (1u << (depth - 1)); ++parent) {
        try_swap(points, views, {&Point::x, depth, parent});
        try_swap(points, views, {&Point::y, depth, parent});
      }
    }
  }
}

}  // namespace pharos::pmj02
