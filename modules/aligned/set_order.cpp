#include "set_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <tuple>

namespace pharos::aligned {
namespace {

void sort(std::span<GridPoint> points, bool by_x) {
  if (points.size() < 2) return;
  const std::size_t half = points.size() / 2;
  // Points with the same x are ordered by y, and vice versa. Only equal points have no order.
  const auto is_lower = [by_x](GridPoint a, GridPoint b) {
    return by_x ? std::tie(a.x, a.y) < std::tie(b.x, b.y) : std::tie(a.y, a.x) < std::tie(b.y, b.x);
  };
  std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(half), points.end(),
                   is_lower);
  sort(points.first(half), !by_x);
  sort(points.subspan(half), !by_x);
}

}  // namespace

void sort_into_cells(std::span<GridPoint> points) {
  sort(points, true);
}

std::vector<std::uint32_t> spread_choices(std::span<const GridPoint> points, double direction) {
  const double angle = direction * std::numbers::pi / 180;
  const double x = std::cos(angle), y = std::sin(angle);
  const auto along = [&](std::size_t i) { return x * points[i].x + y * points[i].y; };
  std::vector<std::size_t> ranked(points.size());
  std::iota(ranked.begin(), ranked.end(), std::size_t{0});
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  std::vector<std::uint32_t> choices(points.size());
  const auto half = static_cast<std::uint32_t>(points.size() / 2);
  for (std::uint32_t rank = 0; rank < ranked.size(); ++rank) {
    std::uint32_t reversed = 0;
    for (std::uint32_t bit = half, digit = 1; bit > 0; bit /= 2, digit *= 2) {
      if ((rank & digit) != 0) reversed += bit;
    }
    choices[ranked[rank]] = reversed * (0x80000000u / half);
  }
  return choices;
}

SetOrders::SetOrders(int bits) : mask_((1u << bits) - 1), shift_(32 - bits) {
  reversed_.assign(std::size_t{1} << bits, 0);
  // Reversed, an index has the bits of its half, shifted by one, and one more bit at the other end.
  for (std::uint32_t i = 1; i <= mask_; ++i) {
    reversed_[i] = reversed_[i / 2] / 2 | (i % 2) << 31;
  }
}

}  // namespace pharos::aligned
