// sphere: an exact sphere, intersected in double precision. `to_world` may rotate, translate,
// mirror and scale evenly. Texture coordinates are (azimuth / 2 pi, angle from +z / pi) in local
// space. Seen from outside, it is sampled uniformly over the directions that meet it (Shirley, Wang
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

/// How far apart the scales along the three axes, or the cosines between them, may be in a map that
/// counts as even: products of rotations in float stay well below.
constexpr float kSimilarityTolerance = 1e-4f;

/// The factor of a map that keeps angles.
std::optional<float> even_scale(const Transform& map) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
  const float scale = length(x);
  const float skew = max_component(Vec3{abs_dot(x, y), abs_dot(y, z), abs_dot(z, x)});
  const float difference = std::max(std::abs(length(y) - scale), std::abs(length(z) - scale));
  const bool even =
      skew <= kSimilarityTolerance * scale * scale && difference <= kSimilarityTolerance * scale;
  return even ? std::optional(scale) : std::nullopt;
}

float world_radius(const Sphere::Settings& settings) {
  const std::optional<float> scale = even_scale(settings.to_world);
  if (!scale) {
    throw InputError(
        "sphere: 'to_world' must scale evenly and not shear; use a mesh for ellipsoids");
  }
  return *scale * settings.radius;
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

void Sphere::Settings::describe(Schema<Settings>& s) {
  s.field("center", &Settings::center, "Centre, before to_world").unit("scene units");
  s.field("radius", &Settings::radius, "Radius, before to_world").unit("scene units").above(0);
  s.field("to_world", &Settings::to_world, "From local to world space; no shear, even scale");
  s.field("flip_normals", &Settings::flip_normals, "Normals point inwards");
}

Sphere::Sphere(const Settings& settings)
    : center_(settings.to_world.point(settings.center)),
      radius_(world_radius(settings)),
      to_world_(settings.to_world),
      flip_normals_(settings.flip_normals) {
  if (!is_finite(center_) || !(area() > 0) || !std::isfinite(area())) {
    throw InputError("sphere: centre and radius are beyond what a float can hold");
  }
}

Bounds3 Sphere::bounds() const {
  Bounds3 box;
  for (int i = 0; i < 3; ++i) {  // outwards, since the sums are rounded
    box.low[i] = std::nextafter(center_[i] - radius_, -kInfinity);
    box.high[i] = std::nextafter(center_[i] + radius_, kInfinity);
  }
  return box;
}

Sphere::Double3 Sphere::from_center(Point3 p) const {
  return {double{p.x} - center_.x, double{p.y} - center_.y, double{p.z} - center_.z};
}

std::optional<std::array<double, 2>> Sphere::roots(const Ray& ray) const {
  const Double3 o = from_center(ray.origin);
  const Double3 d{ray.direction.x, ray.direction.y, ray.direction.z};
  const double a = dot(d, d), b = dot(o, d);
  // The discriminant from the distance between line and centre: b^2 - a c would cancel far away
  // (Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection").
  const double closest = -b / a;
  const Double3 l{o[0] + closest * d[0], o[1] + closest * d[1], o[2] + closest * d[2]};
  const double r2 = double{radius_} * radius_;
  const double discriminant = r2 - dot(l, l);
  if (discriminant < 0) return std::nullopt;
  const double q = -b - std::copysign(std::sqrt(a * discriminant), b);
  const double near = q / a;
  const double other = q != 0 ? (dot(o, o) - r2) / q : near;
  return std::array{std::min(near, other), std::max(near, other)};
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
  // As a float, `hit.t` would misplace the hit on a sphere that is small and far away.
  double t = hit.t;
  if (const auto both = roots(ray)) {
    t = std::abs((*both)[0] - t) <= std::abs((*both)[1] - t) ? (*both)[0] : (*both)[1];
  }
  Double3 p = from_center(ray.origin);
  for (int i = 0; i < 3; ++i) p[static_cast<std::size_t>(i)] += t * ray.direction[i];
  return surface_towards(p);
}

SurfacePoint Sphere::surface_towards(const Double3& outward) const {
  const double scale = 1 / std::sqrt(dot(outward, outward));
  SurfacePoint point;
  Vec3 n;
  for (int i = 0; i < 3; ++i) {
    const double component = scale * outward[static_cast<std::size_t>(i)];
    n[i] = static_cast<float>(component);
    point.position[i] = static_cast<float>(center_[i] + radius_ * component);
  }
  // Position and ray origin are each rounded once, by at most half an epsilon of a coordinate: in
  // three directions sqrt(3) epsilons together. Four leave no ray on the wrong side, because the
  // intersection itself is exact by comparison.
  point.error = 4 * std::numeric_limits<float>::epsilon() * (max_component(abs(center_)) + radius_);
  point.normal = flip_normals_ ? -n : n;
  point.shading = Frame::from_normal(point.normal);
  const Vec3 local = normalize(to_world_.inverse_vector(n));
  const float azimuth = std::atan2(local.y, local.x) / (2 * kPi);
  point.uv = {azimuth < 0 ? azimuth + 1 : azimuth,
              std::acos(std::clamp(local.z, -1.0f, 1.0f)) / kPi};
  return point;
}

ShapeSample Sphere::sample(Vec2 u) const {
  const Vec3 n = warp::sphere_from_square(u);
  return {.point = surface_towards({n.x, n.y, n.z}), .pdf = 1 / area()};
}

std::optional<float> Sphere::cone_from(Point3 from) const {
  // Rounding puts points of the sphere itself on either side; those of a room see its inside.
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
  const double distance = std::sqrt(dot(away, away));
  const Vec3 axis{static_cast<float>(-away[0] / distance), static_cast<float>(-away[1] / distance),
                  static_cast<float>(-away[2] / distance)};
  const Frame frame = Frame::from_normal(axis);
  const Vec3 local = warp::cone_from_square(u, *one_minus_cos);
  // The hit lies in the plane of the direction and the centre: at angle theta from the axis, the
  // ray enters after `along`, whence the hit's components along the axis and beside it.
  const double sin2 = double{local.x} * local.x + double{local.y} * local.y;
  const double cosine = std::sqrt(1 - sin2);
  const double half_chord =
      std::sqrt(std::max(0.0, double{radius_} * radius_ - distance * distance * sin2));
  const double along = distance * cosine - half_chord;
  const double beside_x = along * local.x, beside_y = along * local.y;
  const double forward = along * cosine - distance;  // from the centre, along the axis
  Double3 outward;
  for (int i = 0; i < 3; ++i) {
    outward[static_cast<std::size_t>(i)] =
        beside_x * frame.s[i] + beside_y * frame.t[i] + forward * frame.n[i];
  }
  return {.point = surface_towards(outward), .pdf = warp::cone_pdf(*one_minus_cos)};
}

float Sphere::pdf_from(Point3 from, const SurfacePoint& point) const {
  const std::optional<float> one_minus_cos = cone_from(from);
  if (!one_minus_cos) return Shape::pdf_from(from, point);
  // Only the cap up to the tangent points is seen; its rim gets the benefit of rounding.
  const Double3 to_point = from_center(point.position), away = from_center(from);
  const double slack = point.error * std::sqrt(dot(away, away));
  const bool seen = dot(to_point, away) >= double{radius_} * radius_ - slack;
  return seen ? warp::cone_pdf(*one_minus_cos) : 0;
}

}  // namespace pharos
