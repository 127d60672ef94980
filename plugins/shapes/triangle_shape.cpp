#include "triangle_shape.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>

namespace pharos {

TriangleShape::TriangleShape(TriangleMesh mesh, const std::string& name)
    : mesh_(std::move(mesh)), bounds_(mesh_.bounds()) {
  if (!std::all_of(mesh_.positions.begin(), mesh_.positions.end(),
                   [](Vec3 position) { return is_finite(position); })) {
    throw InputError(name + " has a vertex that is not finite");
  }
  std::vector<std::array<std::uint32_t, 3>> kept;
  double total = 0;
  for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
    const float area = mesh_.area(i);
    if (!(area > 0)) continue;
    total += area;
    kept.push_back(mesh_.triangles[i]);
    area_up_to_.push_back(total);
  }
  mesh_.triangles = std::move(kept);
  mesh_.precompute();
}

ShapeSample TriangleShape::sample(Vec2 u) const {
  const double target = u.x * area_up_to_.back();
  const auto last = area_up_to_.end() - 1;
  const auto chosen = std::upper_bound(area_up_to_.begin(), last, target);
  const double below = chosen == area_up_to_.begin() ? 0 : *(chosen - 1);
  const double remainder = (target - below) / (*chosen - below);
  const Vec2 within{std::min(static_cast<float>(remainder), kOneMinusEpsilon), u.y};
  const auto triangle = static_cast<std::uint32_t>(chosen - area_up_to_.begin());
  return sample_at(triangle, warp::triangle_from_square(within));
}

TriangleMesh transformed(TriangleMesh local, const Transform& to_world, bool flip_normals) {
  for (Point3& p : local.positions) p = to_world.point(p);
  for (Vec3& n : local.normals) {
    const Vec3 normal = to_world.normal(n);
    n = length_squared(n) > 0 ? normalize(flip_normals ? -normal : normal) : n;
  }
  if (to_world.flips_handedness() != flip_normals) {
    for (auto& corner : local.triangles) std::swap(corner[1], corner[2]);
  }
  return local;
}

void check_triangle_count(double count, const std::string& name) {
  constexpr double most = 2e8;
  if (count > most) {
    throw InputError(fmt::format("{} would have {:.0f} triangles; at most {:.0f} are possible",
                                 name, count, most));
  }
}

}  // namespace pharos
