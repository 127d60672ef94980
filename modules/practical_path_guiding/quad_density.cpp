#include "quad_density.h"

#include <algorithm>
#include <cmath>

namespace pharos::practical_path_guiding {
namespace {

/// Returns whether u in [0, 1) selects the upper of two parts, of which the lower one has the share
/// `low`, and rescales u to its position within the selected part.
bool descend(double& u, double low) {
  const bool is_high = u >= low;
  u = is_high ? (u - low) / (1 - low) : u / low;
  constexpr double kLast = 1 - 0x1p-53;
  u = std::min(u, kLast);
  return is_high;
}

bool is_share(float v) {
  return v >= 0 && v <= 1;
}

}  // namespace

float QuadDensity::at(Vec2 p) const {
  // In fixed point, one bit of each coordinate selects the quarter at each level.
  constexpr int kBits = 24;
  auto x = static_cast<std::uint32_t>(p.x * (1 << kBits));
  auto y = static_cast<std::uint32_t>(p.y * (1 << kBits));
  const QuadNode* node = nodes_.data();
  float density = 1;
  while (true) {
    const std::uint32_t quarter = (x >> (kBits - 1) & 1) | (y >> (kBits - 2) & 2);
    density *= 4 * node->share(quarter);
    if (!node->is_divided(quarter)) return density;
    node = nodes_.data() + node->child(quarter);
    x <<= 1;
    y <<= 1;
  }
}

Vec2 QuadDensity::sample(Vec2 u) const {
  double x = u.x, y = u.y, x_low = 0, y_low = 0, size = 1;
  const QuadNode* node = nodes_.data();
  while (true) {
    const unsigned right = descend(x, node->left) ? 1 : 0;
    const unsigned upper = descend(y, node->lower[right]) ? 2 : 0;
    size /= 2;
    x_low += right != 0 ? size : 0;
    y_low += upper != 0 ? size : 0;
    if (!node->is_divided(right | upper)) break;
    node = nodes_.data() + node->child(right | upper);
  }
  const auto within = [](double low, double high) {
    const auto f = static_cast<float>(low);
    return f < high ? f : std::nextafter(static_cast<float>(high), 0.0f);
  };
  return {within(x_low + x * size, x_low + size), within(y_low + y * size, y_low + size)};
}

bool is_density(const std::vector<QuadNode>& nodes) {
  if (nodes.empty()) return true;
  if (nodes.size() > kMostNodes) return false;
  std::vector<int> level(nodes.size(), 1);
  std::uint32_t next = 1;  // index of the first child that follows
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const QuadNode& node = nodes[i];
    if (i >= next || level[i] > QuadDensity::kMostLevels) return false;
    if (!is_share(node.left) || !is_share(node.lower[0]) || !is_share(node.lower[1])) return false;
    const int count = std::popcount(node.children & 15u);
    if (node.children >> 4 != (count > 0 ? next : 0)) return false;
    for (int k = 0; k < count; ++k) {
      if (next >= nodes.size()) return false;
      level[next++] = level[i] + 1;
    }
  }
  return true;
}

}  // namespace pharos::practical_path_guiding
