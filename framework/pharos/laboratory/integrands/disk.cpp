#include <algorithm>
#include <cmath>

#include <pharos/laboratory/convex_region.h>
#include <pharos/laboratory/integrands/disk.h>

namespace pharos::laboratory {
namespace {

/// Returns sqrt(r^2 - t^2) for |t| <= r. The product is never negative, unlike the difference of
/// squares, of which one may be rounded and the other not.
double half_chord(double t, double r) {
  return std::sqrt((r - t) * (r + t));
}

/// Returns the integral of sqrt(r^2 - s^2) over s from 0 to `t`, |t| <= r.
double under_arc(double t, double r) {
  const double height = half_chord(t, r);
  return 0.5 * (t * height + r * r * std::asin(std::clamp(t / r, -1.0, 1.0)));
}

/// Returns the area of the part of the disk with X <= x and Y <= y, for a disk of radius r around
/// the origin. Between the two places where the arc has the height |y|, the column at X reaches
/// from the lower arc to y. Outside of them, the whole column counts if y > 0, and nothing counts
/// if y < 0.
double area_below(double x, double y, double r) {
  x = std::clamp(x, -r, r);
  y = std::clamp(y, -r, r);
  const double a = half_chord(y, r), reach = std::clamp(x, -a, a);
  double sum = under_arc(reach, r) - under_arc(-a, r) + y * (reach + a);
  if (y > 0) {
    sum += 2 * (under_arc(std::min(x, -a), r) - under_arc(-r, r));
    if (x > a) sum += 2 * (under_arc(x, r) - under_arc(a, r));
  }
  return sum;
}

double area_in_square(PlanePoint c, double r) {
  return area_below(1 - c.x, 1 - c.y, r) - area_below(-c.x, 1 - c.y, r) -
         area_below(1 - c.x, -c.y, r) + area_below(-c.x, -c.y, r);
}

}  // namespace

void Disk::Settings::describe(Schema<Settings>& s) {
  s.field("center", &Settings::center, "Center of the disk; may lie outside of the square")
      .unit("sides of the square");
  s.field("radius", &Settings::radius, "Radius of the disk")
      .unit("sides of the square")
      .above(0)
      .at_most(10);
}

Disk::Disk(const Settings& settings)
    : center_{settings.center.x, settings.center.y},
      radius_(settings.radius),
      mean_(dividing_area(area_in_square(center_, radius_), "the disk")) {}

}  // namespace pharos::laboratory
