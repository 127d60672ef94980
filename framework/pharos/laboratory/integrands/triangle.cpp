#include <algorithm>

#include <pharos/laboratory/integrands/triangle.h>

namespace pharos::laboratory {
namespace {

/// Returns the intersection of the half planes left of the sides of a triangle. The triangle is
/// first oriented counter-clockwise.
ConvexRegion region_of(std::vector<Vec2> v) {
  const auto turn = [](Vec2 a, Vec2 b, Vec2 c) {
    return (double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x);
  };
  if (turn(v[0], v[1], v[2]) < 0) std::swap(v[1], v[2]);
  std::vector<HalfPlane> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 a = v[i], b = v[(i + 1) % 3];
    const PlanePoint outward{double{b.y} - a.y, double{a.x} - b.x};
    sides.push_back({outward, outward.x * a.x + outward.y * a.y});
  }
  return ConvexRegion(std::move(sides));
}

}  // namespace

void Triangle::Settings::describe(Schema<Settings>& s) {
  s.field("vertices", &Settings::vertices, "The three corners, in either orientation")
      .unit("sides of the square")
      .check("three points", [](const std::vector<Vec2>& v) { return v.size() == 3; });
}

Triangle::Triangle(const Settings& settings)
    : region_(region_of(settings.vertices)), mean_(required_area(region_, "the triangle")) {}

}  // namespace pharos::laboratory
