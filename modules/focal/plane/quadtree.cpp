#include "quadtree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "guide.h"

namespace pharos::focal::plane {
namespace {

/// Returns the interval of a ray between two parallel lines, at `low` and `low + size` along one
/// axis. If the ray is parallel to these lines and lies on one of them, it belongs to the side
/// above the line only.
Stretch between(double origin, double direction, double low, double size) {
  if (direction == 0) {
    const bool inside = low <= origin && origin < low + size;
    return {0, inside ? std::numeric_limits<double>::infinity() : 0};
  }
  const double a = (low - origin) / direction, b = (low + size - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

Cell Cell::child(unsigned c) const {
  const Point2 half{0.5 * size.x, 0.5 * size.y};
  return {{low.x + (c & 1) * half.x, low.y + (c >> 1) * half.y}, half};
}

Ray::Ray(Point2 from, double angle) : origin(from), direction{std::sin(angle), std::cos(angle)} {}

Stretch Ray::within(const Cell& cell) const {
  const Stretch x = between(origin.x, direction.x, cell.low.x, cell.size.x);
  const Stretch y = between(origin.y, direction.y, cell.low.y, cell.size.y);
  return {std::max({x.begin, y.begin, 0.0}), std::min(x.end, y.end)};
}

/// Makes the nodes of a refined tree, parents before children.
struct Quadtree::Refinement {
  const Quadtree& old;
  const Sums& sums;
  const SplitRule& rule;
  double total;
  Quadtree result{old.region_};

  /// The source of a new node: a node of the old tree, or a uniform distribution of `mass`.
  struct Source {
    std::optional<std::uint32_t> node;
    double mass = 0;
  };

  /// Adds a node and returns its index. The children of the node have `depth`.
  std::uint32_t add(const Source& source, int depth) {
    const auto index = static_cast<std::uint32_t>(result.nodes_.size());
    result.nodes_.emplace_back();
    for (unsigned c = 0; c < 4; ++c) {
      const Source child = child_of(source, c);
      const bool splits = depth < rule.max_depth && child.mass > rule.threshold;
      const std::uint32_t below = splits ? add(child, depth + 1) : 0;
      result.nodes_[index][c] = {below, child.mass};
    }
    return index;
  }

  Source child_of(const Source& source, unsigned c) const {
    if (!source.node) return {std::nullopt, source.mass / 4};
    const std::uint32_t below = old.nodes_[*source.node][c].node;
    if (below == 0) return {std::nullopt, sums[4 * std::size_t{*source.node} + c] / total};
    return {below, old.total_below(below, sums) / total};
  }
};

Quadtree::Quadtree(const Cell& region, const SplitRule& rule) : region_(region) {
  const Sums none;
  Refinement even{.old = *this, .sums = none, .rule = rule, .total = 1};
  even.add({std::nullopt, 1}, 0);
  *this = std::move(even.result);
}

double Quadtree::total_below(std::uint32_t node, const Sums& sums) const {
  double total = 0;
  for (unsigned c = 0; c < 4; ++c) {
    const std::uint32_t below = nodes_[node][c].node;
    total += below != 0 ? total_below(below, sums) : sums[4 * std::size_t{node} + c];
  }
  return total;
}

Quadtree Quadtree::refined(const Sums& sums, const SplitRule& rule) const {
  const double total = total_below(0, sums);
  if (!(total > 0)) return *this;
  Refinement refinement{.old = *this, .sums = sums, .rule = rule, .total = total};
  refinement.add({0u, 1}, 0);
  return std::move(refinement.result);
}

Point2 Quadtree::sample(RandomStream& random) const {
  Cell cell = region_;
  for (std::uint32_t node = 0;;) {
    const Node& children = nodes_[node];
    double u = uniform_number(random) *
               (children[0].mass + children[1].mass + children[2].mass + children[3].mass);
    unsigned c = 0;
    for (; c < 3 && u >= children[c].mass; ++c) u -= children[c].mass;
    cell = cell.child(c);
    if (children[c].node == 0) break;
    node = children[c].node;
  }
  return {cell.low.x + uniform_number(random) * cell.size.x,
          cell.low.y + uniform_number(random) * cell.size.y};
}

double Quadtree::directional_density(const Ray& ray) const {
  double sum = 0;
  traverse(ray, [&sum](const Child& leaf, const Cell& cell, std::size_t, const Stretch& stretch) {
    sum += directional_term(leaf, cell, stretch);
  });
  return sum;
}

}  // namespace pharos::focal::plane
