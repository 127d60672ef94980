// lathe: a surface of revolution, made of triangles. `profile` lists points [r, z], distance from
// the z axis and height. Each pair of neighbors becomes a band of `segments` facets around the
// axis, with corners on the exact circle. If the points go from bottom to top, the outer side faces
// away from the axis; in general it lies to the right of the direction along the profile. A profile
// encloses a solid without gaps if it starts and ends on the axis, or if it returns to its first
// point (counter-clockwise, r to the right and z up).
//
// With `interpolation: catmull_rom` a smooth curve runs through the points, with `subdivisions`
// straight pieces between neighbors. `smooth` interpolates normals around the axis and along the
// profile, except at corners sharper than `crease`. Texture coordinates are (azimuth / 2 pi, arc
// length along the profile in [0, 1]).
//
//     type: lathe                       # a vase with a flat foot
//     profile: [ [0, 0], [0.3, 0], [0.5, 0.5], [0.2, 1], [0.3, 1.2] ]
//     interpolation: linear

#include "lathe.h"

#include <cmath>
#include <numbers>

#include "lathe_profile.h"

namespace pharos {
namespace {

std::vector<ProfilePiece> pieces_of(const Lathe::Settings& settings) {
  check_profile(settings.profile);
  const bool curved = settings.interpolation == ProfileInterpolation::catmull_rom;
  const double pieces_per_point = curved ? settings.subdivisions : 1;
  const double points = static_cast<double>(settings.profile.size());
  check_triangle_count(2 * points * pieces_per_point * settings.segments, "lathe");
  return profile_pieces(
      curved ? catmull_rom(settings.profile, settings.subdivisions) : settings.profile,
      settings.crease);
}

/// Turns the pieces of a profile into bands.
class Turner {
 public:
  Turner(int segments, bool smooth) : segments_(segments), smooth_(smooth) {}

  void add(const ProfilePiece& piece) {
    const std::uint32_t a = add_ring(piece.from, piece.normal_from, piece.v_from);
    const std::uint32_t b = add_ring(piece.to, piece.normal_to, piece.v_to);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments_); ++i) {
      if (piece.from.x > 0) mesh_.triangles.push_back({a + i, a + i + 1, b + i});
      if (piece.to.x > 0) {
        const std::uint32_t low = piece.from.x > 0 ? a + i + 1 : a + i;
        mesh_.triangles.push_back({low, b + i + 1, b + i});
      }
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  /// Adds the vertices of one end of a band. The last vertex has the position of the first, but u =
  /// 1. On the axis each vertex serves one triangle and has the azimuth of the triangle's middle.
  std::uint32_t add_ring(Vec2 point, Vec2 normal, float v) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const double shift = point.x == 0 ? 0.5 : 0;
    for (int i = 0; i <= segments_; ++i) {
      const double angle = 2 * std::numbers::pi * (i % segments_ + shift) / segments_;
      const float c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
      mesh_.positions.push_back({point.x * c, point.x * s, point.y});
      if (smooth_) mesh_.normals.push_back({normal.x * c, normal.x * s, normal.y});
      mesh_.uvs.push_back({static_cast<float>((i + shift) / segments_), v});
    }
    return first;
  }

  int segments_;
  bool smooth_;
  TriangleMesh mesh_;
};

TriangleMesh turned(const Lathe::Settings& settings) {
  Turner turner(settings.segments, settings.smooth);
  for (const ProfilePiece& piece : pieces_of(settings)) turner.add(piece);
  return turner.take();
}

}  // namespace

void Lathe::Settings::describe(Schema<Settings>& s) {
  s.field("profile", &Settings::profile,
          "Points [r, z]; the outer side is on the right of the profile")
      .unit("scene units")
      .required();
  s.field("segments", &Settings::segments, "Number of facets around the axis")
      .at_least(3)
      .at_most(65536);
  s.field("interpolation", &Settings::interpolation, "Straight lines or a spline between points");
  s.field("subdivisions", &Settings::subdivisions,
          "Number of pieces of the spline between two points")
      .at_least(1)
      .at_most(65536);
  s.field("smooth", &Settings::smooth, "Interpolate normals instead of showing facets");
  s.field("crease", &Settings::crease, "Angle above which corners of the profile stay sharp")
      .unit("degrees")
      .at_least(0)
      .at_most(180);
  s.field("to_world", &Settings::to_world, "Transform from local to world space");
  s.field("flip_normals", &Settings::flip_normals, "Exchange the outer and the inner side");
  s.example("{ profile: [[0, -1], [1, 0], [0, 1]], segments: 5, smooth: false }");
  s.example("{ profile: [[0, 0], [0.5, 0.2], [0.2, 1], [0.4, 1.2]], interpolation: catmull_rom }");
  s.example(
      "{ profile: [[2, -1], [3, 0], [2, 1], [1, 0], [2, -1]], interpolation: catmull_rom, "
      "crease: 60, to_world: { scale: [1, 2, 0.5] } }");
}

Lathe::Lathe(const Settings& settings)
    : TriangleShape(transformed(turned(settings), settings.to_world, settings.flip_normals),
                    "lathe"),
      to_world_(settings.to_world),
      smooth_(settings.smooth) {}

UvTangents Lathe::uv_tangents(const SurfacePoint& point) const {
  UvTangents tangents = TriangleShape::uv_tangents(point);
  if (!smooth_) return tangents;
  const Point3 local = to_world_.inverse_point(point.position);
  const Vec3 around = to_world_.vector({-local.y, local.x, 0});
  const float size = length(around);
  if (size > 0) tangents.du = length(tangents.du) / size * around;
  return tangents;
}

}  // namespace pharos
