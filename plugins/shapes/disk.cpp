// disk: the unit disk of the xy plane, transformed to world space by any affine map (which makes it
// an ellipse) and intersected exactly, in double precision. It faces local +z, even under maps that
// mirror. Texture coordinates cover [0,1]^2 with local x and y, so the disk shows a round part of
// an image. Samples are uniform over the area, because an affine map scales all areas of a plane by
// the same factor.
//
//     type: disk
//     to_world: [ { scale: 0.3 }, { rotate: { axis: [1, 0, 0], degrees: 180 } },
//                 { translate: [0, 0, 2] } ]
//     emitter: { type: area, radiance: 10 }

#include "disk.h"

#include <algorithm>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>

#include "round_shape.h"

namespace pharos {
namespace {

float largest(Vec3 v) {
  return max_component(abs(v));
}

/// Returns the smaller semi-axis of the ellipse with conjugate radii x and y. It is the smaller
/// singular value of the matrix [x y], the product of both singular values |x cross y| divided by
/// the larger one.
double smaller_semi_axis(Double3 x, Double3 y) {
  const double xx = dot(x, x), yy = dot(y, y), xy = dot(x, y);
  const double larger = std::sqrt(0.5 * (xx + yy + std::hypot(xx - yy, 2 * xy)));
  return length(cross(x, y)) / larger;
}

}  // namespace

void Disk::Settings::describe(Schema<Settings>& s) {
  s.field("to_world", &Settings::to_world, "Transform from the unit disk to world space");
  s.field("flip_normals", &Settings::flip_normals, "Make the disk face -z instead of +z");
  s.example("{ to_world: [{ scale: 0.3 }, { translate: [1, 2, 3] }], flip_normals: true }");
  s.example("{ to_world: { matrix: [2, 0.5, 0, 1, 0, 0.7, 0.4, -3, 0.3, 0, 1, 2] } }");
}

Disk::Disk(const Settings& settings)
    : center_(settings.to_world.point({})),
      axis_x_(settings.to_world.vector({1, 0, 0})),
      axis_y_(settings.to_world.vector({0, 1, 0})) {
  const Double3 x(axis_x_), y(axis_y_);
  normal_ = cross(x, y);
  const double product = dot(normal_, normal_);
  area_ = static_cast<float>(double{kPi} * std::sqrt(product));
  if (!is_finite(center_) || !(area_ > 0) || !std::isfinite(area_)) {
    throw InputError("disk: center and radius are beyond what a float can hold");
  }
  dual_x_ = (1 / product) * cross(y, normal_);
  dual_y_ = (1 / product) * cross(normal_, x);

  const bool away = settings.to_world.flips_handedness() != settings.flip_normals;
  common_.normal = Vec3((away ? -1.0 : 1.0) * normalize(normal_));
  common_.shading = Frame::from_normal(common_.normal);
  common_.error = exact_shape_error(largest(center_) + largest(axis_x_) + largest(axis_y_));
  const double margin = common_.error / smaller_semi_axis(x, y);
  largest_radius_ = static_cast<float>(1 - std::min(margin, 0.5));
}

Bounds3 Disk::bounds() const {
  Vec3 reach;
  for (int i = 0; i < 3; ++i) reach[i] = std::hypot(axis_x_[i], axis_y_[i]) + common_.error;
  return bounds_around(center_, reach);
}

bool Disk::intersect(const Ray& ray, std::uint32_t, PrimitiveHit& hit) const {
  const Double3 origin = Double3(ray.origin) - Double3(center_);
  const Double3 direction(ray.direction);
  const double t = -dot(origin, normal_) / dot(direction, normal_);
  hit.t = static_cast<float>(t);
  if (!(hit.t > 0 && hit.t < ray.t_max)) return false;  // never for rays within the plane
  const Double3 p = origin + t * direction;
  const double x = dot(p, dual_x_), y = dot(p, dual_y_);
  hit.coordinates = {static_cast<float>(x), static_cast<float>(y)};
  return x * x + y * y <= 1;
}

SurfacePoint Disk::surface_point(const Ray&, const PrimitiveHit& hit) const {
  return surface_at(hit.coordinates);
}

SurfacePoint Disk::surface_at(Vec2 local) const {
  const float radius = std::hypot(local.x, local.y);
  // As with triangles, rays start off the rim so that they do not slip past an adjacent surface.
  const Vec2 inside = radius > largest_radius_ ? largest_radius_ / radius * local : local;
  SurfacePoint point = common_;
  point.position = Vec3(Double3(center_) + (double{inside.x} * Double3(axis_x_) +
                                            double{inside.y} * Double3(axis_y_)));
  point.uv = {0.5f * (1 + local.x), 0.5f * (1 + local.y)};
  return point;
}

UvTangents Disk::uv_tangents(const SurfacePoint&) const {
  return {2 * axis_x_, 2 * axis_y_};
}

ShapeSample Disk::sample(Vec2 u) const {
  return {.point = surface_at(warp::disk_from_square(u)), .pdf = 1 / area_};
}

}  // namespace pharos
