#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/laboratory/convex_region.h>

namespace pharos::laboratory {
namespace {

constexpr double kSmallestComponent = 1e-6;
/// The smallest area that must be inside and outside of a region. Points would rarely find a
/// smaller part of the square.
constexpr double kSmallestArea = 1e-4;

double snapped(double component) {
  return std::abs(component) < kSmallestComponent ? 0 : component;
}

double cross(PlanePoint a, PlanePoint b) {
  return a.x * b.y - a.y * b.x;
}

double sinc(double t) {
  return std::abs(t) < 1e-8 ? 1 : std::sin(t) / t;
}

PlanePoint between(PlanePoint a, PlanePoint b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

std::vector<PlanePoint> clipped(const std::vector<PlanePoint>& polygon, const HalfPlane& side) {
  std::vector<PlanePoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PlanePoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = side.signed_distance(a), db = side.signed_distance(b);
    if (da <= 0) kept.push_back(a);
    if ((da <= 0) != (db <= 0)) kept.push_back(between(a, b, da / (da - db)));
  }
  return kept;
}

/// Calls `each(a, b)` with the two ends of every side.
template <class Each>
void for_sides(const std::vector<PlanePoint>& polygon, Each&& each) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    each(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
}

}  // namespace

PlanePoint direction_at(double degrees) {
  const double angle = degrees * (std::numbers::pi / 180);
  return {snapped(std::cos(angle)), snapped(std::sin(angle))};
}

HalfPlane half_plane(double degrees, double offset) {
  const PlanePoint normal = direction_at(degrees);
  return {normal, offset + 0.5 * (normal.x + normal.y)};
}

ConvexRegion region_of(const std::vector<double>& degrees, const std::vector<double>& offsets) {
  if (!offsets.empty() && offsets.size() != degrees.size()) {
    throw InputError(fmt::format("expected as many offsets as angles, or none, found {} and {}",
                                 offsets.size(), degrees.size()));
  }
  std::vector<HalfPlane> sides;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    sides.push_back(half_plane(degrees[i], offsets.empty() ? 0 : offsets[i]));
  }
  return ConvexRegion(std::move(sides));
}

std::vector<PlanePoint> ConvexRegion::polygon_in_square() const {
  std::vector<PlanePoint> polygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const HalfPlane& side : sides_) polygon = clipped(polygon, side);
  return polygon;
}

double area(const std::vector<PlanePoint>& polygon) {
  double twice = 0;
  for_sides(polygon, [&](PlanePoint a, PlanePoint b) { twice += cross(a, b); });
  return 0.5 * twice;
}

double wave_integral(const std::vector<PlanePoint>& polygon, PlanePoint k) {
  double sum = 0;
  for_sides(polygon, [&](PlanePoint a, PlanePoint b) {
    const PlanePoint d{b.x - a.x, b.y - a.y}, m = between(a, b, 0.5);
    const double half_phase = 0.5 * (k.x * d.x + k.y * d.y);
    sum += std::sin(k.x * m.x + k.y * m.y) * sinc(half_phase) * cross(k, d);
  });
  return sum / (k.x * k.x + k.y * k.y);
}

double dividing_area(double area, const char* what) {
  if (area < kSmallestArea || area > 1 - kSmallestArea) {
    throw InputError(fmt::format("expected {} to divide the unit square, found {} of it inside",
                                 what, area > 0.5 ? "all" : "nothing"));
  }
  return area;
}

double required_area(const ConvexRegion& region, const char* what) {
  return dividing_area(area(region.polygon_in_square()), what);
}

}  // namespace pharos::laboratory
