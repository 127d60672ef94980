#pragma once

#include <vector>

#include <pharos/laboratory/integrand.h>

namespace pharos::laboratory {

/// (cos, sin) of an angle [degrees]. Components below 1e-6 are zero: multiples of 90 degrees are
/// exact, and closed forms that divide by a component keep their digits.
PlanePoint direction_at(double degrees);

/// The points p with normal . p <= bound.
struct HalfPlane {
  PlanePoint normal;
  double bound = 0;

  /// Distance to the border when `normal` is of unit length, negative inside.
  double signed_distance(PlanePoint p) const { return normal.x * p.x + normal.y * p.y - bound; }
};

/// The half plane whose outward normal points to `degrees` and whose border passes the center of
/// the unit square at the distance `offset` along the normal.
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
  /// Its part in the unit square, counter-clockwise; the square clipped by one side after the
  /// other (Sutherland and Hodgman 1974). Empty when nothing of it lies there.
  std::vector<PlanePoint> polygon_in_square() const;

 private:
  std::vector<HalfPlane> sides_;
};

/// The half planes at `degrees`, each with its offset (0 where `offsets` is empty). Throws
/// InputError for other numbers of offsets.
ConvexRegion region_of(const std::vector<double>& degrees, const std::vector<double>& offsets);

/// The area of a counter-clockwise polygon by the shoelace formula.
double area(const std::vector<PlanePoint>& polygon);

/// The integral of cos(k . p) over a counter-clockwise polygon, k not zero. The divergence theorem
/// makes it a sum over the sides: sin(k . m) sinc(k . d / 2) (k x d) / |k|^2, of a side from a to
/// a + d with the middle m.
double wave_integral(const std::vector<PlanePoint>& polygon, PlanePoint k);

/// An area, returned as it is. Throws InputError unless it is that of a part of the unit square,
/// not of all of it; `what` names what has the area in the message, such as "the edges".
double dividing_area(double area, const char* what);

/// The area of the region's part of the unit square. Throws as dividing_area() does.
double required_area(const ConvexRegion& region, const char* what);

}  // namespace pharos::laboratory
