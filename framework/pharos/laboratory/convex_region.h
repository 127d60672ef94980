#pragma once

#include <vector>

#include <pharos/laboratory/integrand.h>

namespace pharos::laboratory {

/// Returns (cos, sin) of an angle [degrees]. Components below 1e-6 become zero. Multiples of 90
/// degrees are therefore exact, and closed forms that divide by a component keep their precision.
PlanePoint direction_at(double degrees);

/// The points p with normal . p <= bound.
struct HalfPlane {
  PlanePoint normal;
  double bound = 0;

  /// Returns the distance to the border, negative inside, if `normal` has unit length.
  double signed_distance(PlanePoint p) const { return normal.x * p.x + normal.y * p.y - bound; }
};

/// Returns the half plane with an outward normal at the angle `degrees`. The border has the
/// distance `offset` along the normal from the center of the unit square.
HalfPlane half_plane(double degrees, double offset);

/// The intersection of half planes.
class ConvexRegion {
 public:
  explicit ConvexRegion(std::vector<HalfPlane> sides) : sides_(std::move(sides)) {}

  bool contains(PlanePoint p) const {
    bool inside = true;
    for (const HalfPlane& side : sides_) inside &= side.signed_distance(p) <= 0;
    return inside;
  }
  /// Returns the part of the region in the unit square, counter-clockwise: the square clipped by
  /// each side in turn (Sutherland and Hodgman 1974). The polygon is empty if the region does not
  /// reach the square.
  std::vector<PlanePoint> polygon_in_square() const;

 private:
  std::vector<HalfPlane> sides_;
};

/// Returns the intersection of the half planes at the angles `degrees`, each with its offset (0 if
/// `offsets` is empty). Throws InputError for any other number of offsets.
ConvexRegion region_of(const std::vector<double>& degrees, const std::vector<double>& offsets);

/// Returns the area of a counter-clockwise polygon by the shoelace formula.
double area(const std::vector<PlanePoint>& polygon);

/// Returns the integral of cos(k . p) over a counter-clockwise polygon, for k other than zero. The
/// divergence theorem makes it a sum over the sides. A side from a to a + d with the middle m
/// contributes sin(k . m) sinc(k . d / 2) (k x d) / |k|^2.
double wave_integral(const std::vector<PlanePoint>& polygon, PlanePoint k);

/// Returns `area` unchanged. Throws InputError unless it is the area of a part of the unit square
/// that is neither nearly empty nor nearly the whole square. `what` names the shape in the message,
/// such as "the edges".
double dividing_area(double area, const char* what);

/// Returns the area of the region's part of the unit square. Throws as dividing_area() does.
double required_area(const ConvexRegion& region, const char* what);

}  // namespace pharos::laboratory
