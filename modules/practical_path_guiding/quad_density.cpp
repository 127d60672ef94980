#include "quad_density.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quad_links.h"

namespace pharos::practical_path_guiding {
namespace {

/// Returns whether u in [0, 1) selects the upper of two parts with weights `low` and `high`, and
/// rescales u to its position within the selected part.
bool descend(double& u, double low, double high) {
  const double scaled = u * (low + high);
  const bool is_high = scaled >= low && high > 0;
  u = is_high ? (scaled - low) / high : scaled / low;
  constexpr double kLast = 1 - 0x1p-53;
  u = std::min(u, kLast);
  return is_high;
}

}  // namespace

float QuadDensity::at(Vec2 p) const {
  // In fixed point, one bit of each coordinate selects the quarter at each level.
  constexpr int kBits = 24;
  auto x = static_cast<std::uint32_t>(p.x * (1 << kBits));
  auto y = static_cast<std::uint32_t>(p.y * (1 << kBits));
  const QuadNode* node = nodes_.data();
  while (true) {
    const std::uint32_t quarter = (x >> (kBits - 1) & 1) | (y >> (kBits - 2) & 2);
    const std::uint32_t child = node->child[quarter];
    if (child == 0) return node->density[quarter];
    node = nodes_.data() + child;
    x <<= 1;
    y <<= 1;
  }
}

Vec2 QuadDensity::sample(Vec2 u) const {
  double x = u.x, y = u.y, x_low = 0, y_low = 0, size = 1;
  std::uint32_t at = 0;
  do {
    const QuadNode& node = nodes_[at];
    const float* d = node.density;
    const unsigned right = descend(x, double{d[0]} + d[2], double{d[1]} + d[3]) ? 1 : 0;
    const unsigned upper = descend(y, d[right], d[right + 2]) ? 2 : 0;
    size /= 2;
    x_low += right != 0 ? size : 0;
    y_low += upper != 0 ? size : 0;
    at = node.child[right | upper];
  } while (at != 0);
  const auto within = [](double low, double high) {
    const auto f = static_cast<float>(low);
    return f < high ? f : std::nextafter(static_cast<float>(high), 0.0f);
  };
  return {within(x_low + x * size, x_low + size), within(y_low + y * size, y_low + size)};
}

bool is_density(const std::vector<QuadNode>& nodes) {
  if (nodes.empty()) return true;
  if (nodes.size() > kMostNodes || !is_quadtree(nodes, QuadDensity::kMostLevels)) return false;
  constexpr double kRounding = 1e-3;
  constexpr double kSmallest = std::numeric_limits<float>::min();  // below, floats lose digits
  const auto mean_of = [&](std::uint32_t i) {
    double sum = 0;
    for (const float d : nodes[i].density) sum += d;
    return sum / 4;
  };
  if (!(std::abs(mean_of(0) - 1) < kRounding)) return false;
  // The density of a quarter is the mean of the densities below it.
  for (const QuadNode& node : nodes) {
    for (int q = 0; q < 4; ++q) {
      const double own = node.density[q];
      if (own < 0) return false;
      const bool is_divided = node.child[q] != 0;
      if (!is_divided) continue;
      const double difference = std::abs(mean_of(node.child[q]) - own);
      if (!(difference <= kRounding * own + kSmallest)) return false;
    }
  }
  return true;
}

}  // namespace pharos::practical_path_guiding
