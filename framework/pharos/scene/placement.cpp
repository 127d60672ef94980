#include <cmath>
#include <limits>

#include <pharos/core/error.h>
#include <pharos/scene/placement.h>
#include <pharos/scene/shape.h>

namespace pharos {
namespace {

Vec3 scaled(Vec3 v, double factor) {
  return {static_cast<float>(factor * v.x), static_cast<float>(factor * v.y),
          static_cast<float>(factor * v.z)};
}

/// Returns the image of a point, rounded once.
Point3 precise_point(const Transform& map, Point3 p) {
  Point3 image;
  for (int r = 0; r < 3; ++r) {
    const auto& row = map.matrix()[static_cast<std::size_t>(r)];
    image[r] = static_cast<float>(double{row[0]} * p.x + double{row[1]} * p.y +
                                  double{row[2]} * p.z + row[3]);
  }
  return image;
}

}  // namespace

Bounds3 placed_bounds(const Bounds3& local, const Transform& to_world) {
  Bounds3 all;
  if (local.empty()) return all;
  for (int corner = 0; corner < 8; ++corner) {
    all.add(to_world.point({(corner & 1) != 0 ? local.high.x : local.low.x,
                            (corner & 2) != 0 ? local.high.y : local.low.y,
                            (corner & 4) != 0 ? local.high.z : local.low.z}));
  }
  if (!is_finite(all.low) || !is_finite(all.high)) {
    throw InputError("an instance lies beyond what a float can hold");
  }
  return all;
}

Placement::Placement(const Transform& to_world) : to_world_(to_world) {
  const Transform::Matrix& m = to_world.matrix();
  double permanent = 0, determinant = 0;
  std::array<std::array<double, 3>, 3> minors;  // sums of the magnitudes of both products
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto &row1 = m[(r + 1) % 3], &row2 = m[(r + 2) % 3];
      const double first = double{row1[(c + 1) % 3]} * row2[(c + 2) % 3];
      const double second = double{row1[(c + 2) % 3]} * row2[(c + 1) % 3];
      minors[r][c] = std::abs(first) + std::abs(second);
      if (r > 0) continue;
      permanent += std::abs(m[0][c]) * minors[0][c];
      determinant += m[0][c] * (first - second);
    }
  }
  const double volume = std::abs(determinant);
  for (std::size_t c = 0; c < 3; ++c) {
    inverse_magnitude_[c] = {static_cast<float>(minors[c][0] / volume),
                             static_cast<float>(minors[c][1] / volume),
                             static_cast<float>(minors[c][2] / volume)};
  }
  condition_ = static_cast<float>(permanent / volume);
}

Placement::LocalRay Placement::to_local(const Ray& ray) const {
  const Vec3 direction = to_world_.inverse_vector(ray.direction);
  const double scale = precise_length(direction);
  const float factor = static_cast<float>(scale);
  return {{to_world_.inverse_point(ray.origin), scaled(direction, 1 / scale), factor * ray.t_max},
          factor};
}

// Embree intersects a placed surface in local space. It takes the ray there by its own inverse W of
// the map. Let p be a point of the surface in local space, and x = M p + t the same point in world
// space. Embree thus meets p at W x, which differs from p by at most
//
//     eps A ((5 + 3 k) |M p| + 2.5 (|x| + |t|))        eps = 2^-23
//
// in each component. A is |W|, except that the products in W's cofactors are added without their
// signs. k >= 1 is the determinant with its products added without their signs, over the magnitude
// of the determinant. The bound covers the sum of these errors:
//
// - The elements of W are cofactors (eps A) over the determinant (3 eps k). Together with the
//   division they are off by (4 + 3 k) eps A. They act on x - t = M p, because W's translation is
//   computed from them.
// - Computing W's translation takes three roundings (1.5 eps A |t|).
// - Applying W takes three roundings, the last one of a sum near p
//   (eps A (|x| + |t| + |M p| / 2)).
// - x and the ray's origin are rounded once each (eps |x|).
//
// The component of this error along the local normal n, divided by the length of W^T n, is a
// distance along the normal in world space. The shape's local error is converted in the same way.
// If the map stretches or shears, a step of this length along the world normal may lead sideways in
// local space, towards neighboring triangles at concave edges. `margin` therefore covers
// kEdgeMargin times the full length of the step, in addition to the error itself.
PlacementError Placement::error_at(const SurfacePoint& local) const {
  constexpr float epsilon = std::numeric_limits<float>::epsilon();
  const Transform::Matrix& m = to_world_.matrix();
  const Vec3 translation{m[0][3], m[1][3], m[2][3]};
  const Vec3 from_origin = to_world_.vector(local.position);
  const Vec3 sizes = (5 + 3 * condition_) * abs(from_origin) +
                     2.5f * (abs(from_origin + translation) + abs(translation));
  const Vec3 rounding =
      epsilon * (sizes.x * inverse_magnitude_[0] + sizes.y * inverse_magnitude_[1] +
                 sizes.z * inverse_magnitude_[2]);
  const Vec3 normal = to_world_.normal(local.normal);
  const double scale = precise_length(normal);
  const double along_normal = local.error + dot(abs(local.normal), rounding);
  const float error = static_cast<float>(along_normal / scale);
  const double step = precise_length(to_world_.inverse_vector(scaled(normal, 1 / scale))) * error;
  return {.world = error,
          .margin = static_cast<float>(kEdgeMargin * step + precise_length(rounding))};
}

SurfacePoint Placement::to_world(const SurfacePoint& local, float error) const {
  SurfacePoint point = local;
  const Vec3 normal = to_world_.normal(local.normal);
  point.position = precise_point(to_world_, local.position);
  point.normal = scaled(normal, 1 / precise_length(normal));
  point.error = error;
  const Vec3 shading = to_world_.normal(local.shading.n);
  const float side = dot(shading, point.normal);
  point.shading =
      side == 0 ? Frame::from_normal(point.normal)
                : Frame::along(scaled(shading, std::copysign(1 / precise_length(shading), side)),
                               to_world_.vector(local.shading.s));
  return point;
}

}  // namespace pharos
