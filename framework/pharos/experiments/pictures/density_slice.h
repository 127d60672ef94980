#pragma once

#include <string>

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/color_map.h>
#include <pharos/guiding/contract/model.h>

namespace pharos {

/// The names of the axes 0, 1 and 2.
inline constexpr char kAxisNames[] = "xyz";

/// A rectangle in space and the size of its picture. A position (u, v) in [0,1]^2 starts at the
/// upper left corner, with v downwards.
struct SlicePlane {
  Point3 corner;      ///< upper left corner [scene units]
  Vec3 right, down;   ///< orthogonal edges [scene units]
  int width, height;  ///< [pixels]
  int axis;           ///< the axis orthogonal to the rectangle

  Point3 at(float u, float v) const { return corner + u * right + v * down; }
  /// Returns the directions of the axes, such as "x to the right, y up".
  std::string orientation() const;
};

/// Returns the slice through `bounds` on which coordinate `axis` is `value`. The longer edge has
/// `size` pixels. y points up, except in the slice orthogonal to y, which is seen from above with x
/// to the right.
SlicePlane slice_plane(const Bounds3& bounds, int axis, float value, int size);

/// Returns GuidingModel::density(point) at the pixels' centers, in one channel "Y".
Image density_slice(const GuidingModel& model, const SlicePlane& plane);

/// Returns the direction that a latitude-longitude image shows at (u, v), where (0, 0) is the upper
/// left corner. y is up, and the middle of the image is +z (docs/conventions.md, environment maps).
Vec3 latlong_direction(float u, float v);

/// Returns GuidingModel::density(point, direction) at the pixels' centers of a latitude-longitude
/// image, in one channel "Y". The image is twice as wide as it is high.
Image density_directions(const GuidingModel& model, Point3 point, int height);

/// Returns a logarithmic scale of the positive finite values of `map`. The densest pixels that hold
/// 1 % of the sum of all pixels get the brightest color, and those beyond 99.9 % of the sum the
/// darkest. The scale spans at most six decades. If no value is positive, it is 0 to 1.
ColorScale density_scale(const Image& map);

/// The column and the row of a pixel, from the upper left corner.
struct PixelPosition {
  int x = 0, y = 0;
};

/// Returns the first pixel of the largest finite value, row by row; (0, 0) if there is none.
PixelPosition densest_pixel(const Image& map);

/// Draws a ring around a pixel of `colors` (three channels, linear). Its radius is a fortieth of
/// the longer edge, and at least four pixels.
void draw_ring(Image& colors, PixelPosition middle);

}  // namespace pharos
