// sphere: an exact sphere, intersected in double precision. `to_world` may rotate, translate,
// mirror and scale uniformly. Texture coordinates are (azimuth / 2 pi, angle from +z / pi) in local
// space. From outside, samples are uniform over the directions that meet the sphere (Shirley, Wang
// and Zimmerman 1996, "Monte Carlo Techniques for Direct Lighting Calculations").
//
//     type: sphere
//     center: [0, 0, 1]
//     radius: 0.5

#include "sphere.h"

#include <algorithm>

#include <pharos/core/error.h>
#include <pharos/core/warp.h>

namespace pharos {
namespace {

float world_radius(const Sphere::Settings& settings) {
  const std::optional<float> scale = even_scale(settings.to_world);
  if (!scale) {
    throw InputError(
        "sphere: 'to_world' must scale evenly and not shear; use a mesh for ellipsoids");
  }
  return *scale * settings.radius;
}

}  // namespace

void Sphere::Settings::describe(Schema<Settings>& s) {
  s.field("center", &Settings::center, "Center, before to_world").unit("scene units");
  s.field("radius", &Settings::radius, "Radius, before to_world").unit("scene units").above(0);
  s.field("to_world", &Settings::to_world,
          "Transform from local to world space; no shear, uniform scale");
  s.field("flip_normals", &Settings::flip_normals, "Make normals point inwards");
  s.example("{ center: [1, 2, 3], radius: 0.5 }");
  s.example(
      "{ to_world: [{ scale: 3 }, { rotate: { axis: [1, 2, 3], degrees: 40 } }], "
      "flip_normals: true }");
}

Sphere::Sphere(const Settings& settings)
    : center_(settings.to_world.point(settings.center)),
      radius_(world_radius(settings)),
      to_world_(settings.to_world),
      flip_normals_(settings.flip_normals) {
  if (!is_finite(center_) || !(area() > 0) || !std::isfinite(area())) {
    throw InputError("sphere: center and radius are beyond what a float can hold");
  }
}

Bounds3 Sphere::bounds() const {
  return bounds_around(center_, {radius_, radius_, radius_});
}

std::optional<std::array<double, 2>> Sphere::roots(const Ray& ray) const {
  return distance_roots(from_center(ray.origin), Double3(ray.direction), radius_);
}

bool Sphere::intersect(const Ray& ray, std::uint32_t, PrimitiveHit& hit) const {
  const auto both = roots(ray);
  if (!both) return false;
  for (const double root : *both) {
    const float t = static_cast<float>(root);
    if (!(t > 0 && t < ray.t_max)) continue;
    hit.t = t;
    return true;
  }
  return false;
}

SurfacePoint Sphere::surface_point(const Ray& ray, const PrimitiveHit& hit) const {
  // As a float, `hit.t` would displace the hit on a sphere that is small and far away.
  double t = hit.t;
  if (const auto both = roots(ray)) {
    t = std::abs((*both)[0] - t) <= std::abs((*both)[1] - t) ? (*both)[0] : (*both)[1];
  }
  return surface_towards(from_center(ray.origin) + t * Double3(ray.direction));
}

SurfacePoint Sphere::surface_towards(Double3 outward) const {
  const Double3 exact_normal = normalize(outward);
  const Vec3 n(exact_normal);
  SurfacePoint point;
  point.position = Vec3(Double3(center_) + radius_ * exact_normal);
  point.error = exact_shape_error(max_component(abs(center_)) + radius_);
  point.normal = flip_normals_ ? -n : n;
  point.shading = Frame::from_normal(point.normal);
  const Vec3 local = normalize(to_world_.inverse_vector(n));
  point.uv = {azimuth_fraction(local.x, local.y),
              std::acos(std::clamp(local.z, -1.0f, 1.0f)) / kPi};
  return point;
}

UvTangents Sphere::uv_tangents(const SurfacePoint& point) const {
  const Vec3 outward = flip_normals_ ? -point.normal : point.normal;
  const Vec3 local = normalize(to_world_.inverse_vector(outward));
  const float beside_axis = std::hypot(local.x, local.y);
  if (beside_axis == 0) return {};
  const Vec3 by_azimuth{-local.y, local.x, 0};
  const Vec3 by_polar{local.x * local.z / beside_axis, local.y * local.z / beside_axis,
                      -beside_axis};
  const float scale = radius_ / length(to_world_.vector({0, 0, 1}));
  return {2 * kPi * scale * to_world_.vector(by_azimuth), kPi * scale * to_world_.vector(by_polar)};
}

ShapeSample Sphere::sample(Vec2 u) const {
  const Vec3 n = warp::sphere_from_square(u);
  return {.point = surface_towards(Double3(n)), .pdf = 1 / area()};
}

std::optional<float> Sphere::cone_from(Point3 from) const {
  // Rounding puts points of the sphere itself on either side. Points of a flipped sphere (a room)
  // see its inside.
  if (flip_normals_) return std::nullopt;
  const Double3 axis = from_center(from);
  const double sin_squared = double{radius_} * radius_ / dot(axis, axis);
  if (!(sin_squared < 1)) return std::nullopt;
  // 1 - cos without cancellation, so that small and far spheres keep their solid angle.
  return static_cast<float>(sin_squared / (1 + std::sqrt(1 - sin_squared)));
}

ShapeSample Sphere::sample_from(Point3 from, Vec2 u) const {
  const std::optional<float> one_minus_cos = cone_from(from);
  if (!one_minus_cos) return Shape::sample_from(from, u);
  const Double3 away = from_center(from);
  const double distance = length(away);
  const Frame frame = Frame::from_normal(Vec3((-1 / distance) * away));
  const Vec3 local = warp::cone_from_square(u, *one_minus_cos);
  // The hit lies in the plane of the direction and the center. At angle theta from the axis the ray
  // enters after `along`, which gives the components of the hit along the axis and perpendicular to
  // it.
  const double sin2 = double{local.x} * local.x + double{local.y} * local.y;
  const double cosine = std::sqrt(1 - sin2);
  const double half_chord =
      std::sqrt(std::max(0.0, double{radius_} * radius_ - distance * distance * sin2));
  const double along = distance * cosine - half_chord;
  const double beside_x = along * local.x, beside_y = along * local.y;
  const double forward = along * cosine - distance;  // from the center, along the axis
  const Double3 outward =
      beside_x * Double3(frame.s) + beside_y * Double3(frame.t) + forward * Double3(frame.n);
  return {.point = surface_towards(outward), .pdf = warp::cone_pdf(*one_minus_cos)};
}

float Sphere::pdf_from(Point3 from, const SurfacePoint& point) const {
  const std::optional<float> one_minus_cos = cone_from(from);
  if (!one_minus_cos) return Shape::pdf_from(from, point);
  // Only the cap up to the tangent points is visible. Tolerates rounding at its rim.
  const Double3 to_point = from_center(point.position), away = from_center(from);
  const double slack = point.error * length(away);
  const bool seen = dot(to_point, away) >= double{radius_} * radius_ - slack;
  return seen ? warp::cone_pdf(*one_minus_cos) : 0;
}

}  // namespace pharos
