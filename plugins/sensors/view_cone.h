#pragma once

#include <cmath>
#include <optional>

#include <pharos/core/transform.h>
#include <pharos/scene/sensor.h>

#include "film_window.h"

namespace pharos {

/// Directions through a film window at local z = 1, seen from the local origin or from a point
/// beside it. A point beside the origin looks through the same window with all slopes shifted.
class ViewCone {
 public:
  /// Takes the angle `fov` between the left and the right edge [degrees].
  ViewCone(const Transform& to_world, float fov, float aspect)
      : to_world_(to_world), window_(std::tan(radians(fov) / 2), aspect) {
    const Vec3 x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0});
    const Vec3 z = to_world.vector({0, 0, 1});
    volume_ = abs_dot(cross(x, y), z);
    normal_ = normalize(z);
  }

  /// Returns the point (x, y, 0) of local space, on a lens that faces the view direction.
  LensPoint lens_point(Vec2 local) const {
    return {.position = to_world_.point({local.x, local.y, 0}), .normal = normal_};
  }

  /// Returns the unit direction of a film position, with `shift` subtracted from its slopes in x
  /// and y.
  Vec3 direction(Vec2 film, Vec2 shift) const {
    const Vec2 slope = window_.point(film) - shift;
    return normalize(to_world_.vector({slope.x, slope.y, 1}));
  }

  /// Inverts direction() and adds the density of directions.
  std::optional<SensorResponse> response(Vec3 direction, Vec2 shift) const {
    const Vec3 local = to_world_.inverse_vector(direction);
    if (!(local.z > 0)) return std::nullopt;
    const Vec2 slope{local.x / local.z, local.y / local.z};
    const std::optional<Vec2> film = window_.film(slope + shift);
    if (!film) return std::nullopt;
    // The uniform density 1/A on the window at z = 1 is |v|^3 / (A z^3) in solid angle about a
    // local direction v, independent of the window's position. A linear map of determinant D onto
    // unit directions divides it by |v|^3 D.
    return SensorResponse{*film, 1 / (window_.area() * volume_ * local.z * local.z * local.z)};
  }

 private:
  Transform to_world_;
  FilmWindow window_;
  float volume_;  ///< |determinant| of to_world's linear part
  Vec3 normal_;
};

}  // namespace pharos
