#pragma once

#include <cmath>
#include <cstdint>

#include <pharos/guiding/toolkit/kd_tree.h>

namespace pharos::practical_path_guiding {

/// The number of ways to face along the axes.
constexpr std::uint32_t kFacings = 6;

/// Returns along which axis, and which way, a normal points most: 2 * axis, + 1 for the negative
/// way. A zero normal, in media, belongs to the first.
inline std::uint32_t facing_of(Vec3 normal) {
  int axis = std::abs(normal.y) > std::abs(normal.x) ? 1 : 0;
  if (std::abs(normal.z) > std::abs(normal[axis])) axis = 2;
  return 2 * static_cast<std::uint32_t>(axis) + (normal[axis] < 0 ? 1 : 0);
}

/// The cells that learn apart: the cells of a binary tree over space, and where `by_facing` is set,
/// in each of them one for each facing.
struct Cells {
  KdTree space;
  bool by_facing = false;

  std::uint32_t in_each() const { return by_facing ? kFacings : 1; }
  std::uint32_t count() const { return space.cell_count() * in_each(); }
  /// Returns the number of the cell of a point on a surface with this facing. It is below count().
  std::uint32_t at(Point3 point, std::uint32_t facing) const {
    const std::uint32_t cell = space.cell_at(point);
    return by_facing ? cell * kFacings + facing : cell;
  }
  std::uint32_t at(Point3 point, Vec3 normal) const {
    return at(point, by_facing ? facing_of(normal) : 0);
  }
  void archive(Archive& archive) { archive(space, by_facing); }
};

}  // namespace pharos::practical_path_guiding
