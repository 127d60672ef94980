// cylinder: an open tube between the points `p0` and `p1`, intersected exactly, in double
// precision, from outside and inside. Two disks can close it. `to_world` may rotate, translate,
// mirror and scale uniformly. Texture coordinates are (azimuth / 2 pi, height from p0 to p1 in [0,
// 1]); for a tube along +z, azimuth zero lies at +x.
//
// Samples for a reference point are uniform over the height and over the angle about the point in
// projection along the axis. They lie on the side of the wall that faces the point. A strip of
// angle d(psi) and height dz at distance rho in projection and d in space covers rho^2 / d^3 d(psi)
// dz [sr]. The density is therefore d^3 / (angle height rho^2). Unlike a density uniform over the
// area, it remains finite at the silhouette.
//
//     type: cylinder
//     p0: [-1, 0, 2]
//     p1: [1, 0, 2]
//     radius: 0.02
//     emitter: { type: area, radiance: 40 }

#include "cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pharos/core/error.h>

#include "round_shape.h"

namespace pharos {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;

float world_scale(const Transform& to_world) {
  const std::optional<float> scale = even_scale(to_world);
  if (!scale) {
    throw InputError(
        "cylinder: 'to_world' must scale evenly and not shear; use a lathe for elliptic tubes");
  }
  return *scale;
}

}  // namespace

void Cylinder::Settings::describe(Schema<Settings>& s) {
  s.field("p0", &Settings::p0, "Center of one end, before to_world").unit("scene units");
  s.field("p1", &Settings::p1, "Center of the other end, before to_world").unit("scene units");
  s.field("radius", &Settings::radius, "Radius, before to_world").unit("scene units").above(0);
  s.field("to_world", &Settings::to_world,
          "Transform from local to world space; no shear, uniform scale");
  s.field("flip_normals", &Settings::flip_normals, "Make normals point inwards");
  s.example("{ p0: [1, 2, 3], p1: [-1, 0, 4], radius: 0.05 }");
  s.example("{ radius: 2, flip_normals: true, to_world: { scale: 3 } }");
}

Cylinder::Cylinder(const Settings& settings)
    : base_(settings.to_world.point(settings.p0)),
      radius_(double{world_scale(settings.to_world)} * settings.radius),
      flip_normals_(settings.flip_normals) {
  const Transform& to_world = settings.to_world;
  const Vec3 local_axis = settings.p1 - settings.p0;
  const Double3 along(to_world.vector(local_axis));
  height_ = length(along);
  if (height_ == 0) throw InputError("cylinder: 'p0' and 'p1' are the same point");
  axis_ = (1 / height_) * along;
  const Frame frame = Frame::from_normal(normalize(local_axis));
  const Double3 side(to_world.vector(frame.s));
  side_ = normalize(side - dot(side, axis_) * axis_);
  across_ = (to_world.flips_handedness() ? -1.0 : 1.0) * cross(axis_, side_);

  area_ = static_cast<float>(kFullTurn * radius_ * height_);
  error_ = exact_shape_error(max_component(abs(base_)) + static_cast<float>(height_ + radius_));
  if (!(area_ > 0) || !std::isfinite(area_) || !std::isfinite(error_)) {
    throw InputError("cylinder: ends and radius are beyond what a float can hold");
  }
}

Bounds3 Cylinder::bounds() const {
  Bounds3 box;
  const Vec3 reach =
      Vec3(radius_ * Double3{std::hypot(side_.x, across_.x), std::hypot(side_.y, across_.y),
                             std::hypot(side_.z, across_.z)}) +
      Vec3{error_, error_, error_};
  box.add(bounds_around(base_, reach));
  box.add(bounds_around(Vec3(Double3(base_) + height_ * axis_), reach));
  return box;
}

bool Cylinder::intersect(const Ray& ray, std::uint32_t, PrimitiveHit& hit) const {
  const Double3 o = to_local(ray.origin), d = to_local(Double3(ray.direction));
  const auto roots = distance_roots({o.x, o.y, 0}, {d.x, d.y, 0}, radius_);
  if (!roots) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    const double t = (*roots)[i], z = o.z + t * d.z;
    hit = {.t = static_cast<float>(t), .coordinates = {static_cast<float>(i), 0}, .primitive = 0};
    if (hit.t > 0 && hit.t < ray.t_max && z >= 0 && z <= height_) return true;
  }
  return false;
}

SurfacePoint Cylinder::surface_point(const Ray& ray, const PrimitiveHit& hit) const {
  const Double3 o = to_local(ray.origin), d = to_local(Double3(ray.direction));
  // As a float, `hit.t` would displace the hit on a tube that is thin and far away.
  const auto roots = distance_roots({o.x, o.y, 0}, {d.x, d.y, 0}, radius_);
  return surface_near(o + (roots ? (*roots)[hit.coordinates.x == 0 ? 0 : 1] : hit.t) * d);
}

SurfacePoint Cylinder::surface_near(Double3 local) const {
  const double scale = 1 / std::hypot(local.x, local.y);
  const Double3 outward = (scale * local.x) * side_ + (scale * local.y) * across_;
  // As with triangles, rays start off the rims so that they do not slip past an adjacent surface.
  const double margin = std::min(double{error_}, 0.5 * height_);
  const double height = std::clamp(local.z, margin, height_ - margin);
  SurfacePoint point;
  point.position = Vec3(Double3(base_) + (radius_ * outward + height * axis_));
  point.error = error_;
  point.normal = flip_normals_ ? -Vec3(outward) : Vec3(outward);
  point.shading = Frame::from_normal(point.normal);
  point.uv = {azimuth_fraction(static_cast<float>(local.x), static_cast<float>(local.y)),
              static_cast<float>(std::clamp(local.z / height_, 0.0, 1.0))};
  return point;
}

UvTangents Cylinder::uv_tangents(const SurfacePoint& point) const {
  const Double3 outward((flip_normals_ ? -1.0f : 1.0f) * point.normal);
  const Double3 by_azimuth = dot(outward, side_) * across_ - dot(outward, across_) * side_;
  return {Vec3(kFullTurn * radius_ * by_azimuth), Vec3(height_ * axis_)};
}

ShapeSample Cylinder::sample(Vec2 u) const {
  const double azimuth = kFullTurn * u.x;
  return {.point = surface_near({std::cos(azimuth), std::sin(azimuth), u.y * height_}),
          .pdf = 1 / area_};
}

double Cylinder::half_angle_from(Double3 local) const {
  const double distance = std::hypot(local.x, local.y);
  return distance > radius_ ? std::asin(radius_ / distance) : std::numbers::pi;
}

ShapeSample Cylinder::sample_from(Point3 from, Vec2 u) const {
  const Double3 local = to_local(from);
  const double distance = std::hypot(local.x, local.y);
  const double half_angle = half_angle_from(local);
  // In projection: the angle from the direction to the axis, and the intersection with the circle.
  const double angle = (2.0 * u.x - 1) * half_angle;
  const double foot = distance * std::cos(angle), offset = distance * std::sin(angle);
  const double half_chord = std::sqrt(std::max(0.0, (radius_ - offset) * (radius_ + offset)));
  const bool near = distance > radius_ && !flip_normals_;
  const double along = near ? foot - half_chord : foot + half_chord;
  const double azimuth = std::atan2(-local.y, -local.x) + angle;
  ShapeSample s;
  s.point = surface_near(
      {local.x + along * std::cos(azimuth), local.y + along * std::sin(azimuth), u.y * height_});
  s.pdf = strip_pdf(local, s.point);
  return s;
}

float Cylinder::pdf_from(Point3 from, const SurfacePoint& point) const {
  const Double3 local = to_local(from);
  const bool outside = std::hypot(local.x, local.y) > radius_;
  // Tolerates rounding at the silhouette.
  if (outside && dot(from - point.position, point.normal) < -point.error) return 0;
  return strip_pdf(local, point);
}

float Cylinder::strip_pdf(Double3 local, const SurfacePoint& point) const {
  const Double3 d = to_local(point.position) - local;
  const double across_squared = d.x * d.x + d.y * d.y;
  if (across_squared == 0) return 0;
  const double distance = length(d);
  return static_cast<float>(distance * distance * distance /
                            (2 * half_angle_from(local) * height_ * across_squared));
}

}  // namespace pharos
