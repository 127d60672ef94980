#pragma once

#include <string>

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/color_map.h>
#include <pharos/guiding/contract/model.h>

namespace pharos {

/// The names of the axes 0, 1 and 2.
inline constexpr char kAxisNames[] = "xyz";

/// A rectangle in space and the picture of it. The position (u, v) in [0,1]^2 is counted from the
/// left upper corner, v downwards.
struct SlicePlane {
  Point3 corner;      ///< left upper [scene units]
  Vec3 right, down;   ///< its edges, orthogonal [scene units]
  int width, height;  ///< [pixels]
  int axis;           ///< that it is orthogonal to

  Point3 at(float u, float v) const { return corner + u * right + v * down; }
  /// Which way the axes run: "x to the right, y up".
  std::string orientation() const;
};

/// The slice through `bounds` on which coordinate `axis` is `value`, its longer edge `size` pixels.
/// y runs upwards where it can; the slice orthogonal to y is seen from above, x to the right.
SlicePlane slice_plane(const Bounds3& bounds, int axis, float value, int size);

/// GuidingModel::density(point) at the pixels' centres; one channel, "Y".
Image density_slice(const GuidingModel& model, const SlicePlane& plane);

/// The direction that a latitude-longitude image shows at (u, v), counted from the left upper
/// corner: y is up, the middle of the image is +z (docs/conventions.md, environment maps).
Vec3 latlong_direction(float u, float v);

/// GuidingModel::density(point, direction) at the pixels' centres of a latitude-longitude image
/// twice as wide as it is high; one channel, "Y".
Image density_directions(const GuidingModel& model, Point3 point, int height);

/// A logarithmic scale up to the largest finite value of `map`, over at most six decades and not
/// below its smallest positive value. Where no value is positive, 0 to 1.
ColorScale density_scale(const Image& map);

}  // namespace pharos
