#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>

#include <pharos/core/simd.h>
#include <pharos/scene/shape.h>

namespace pharos {
namespace {

/// Three doubles, for the few steps in which float would lose precision of the scene's coordinates.
struct Vec3d {
  double x, y, z;

  explicit Vec3d(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  Vec3d(double a, double b, double c) : x(a), y(b), z(c) {}

  friend Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3d operator*(double s, Vec3d v) { return {s * v.x, s * v.y, s * v.z}; }
};

Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(Vec3d v) {
  return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
Vec3 to_float(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
float sum(Vec3 v) {
  return v.x + v.y + v.z;
}

/// Constants of the distance that origin_towards() must step from a triangle, in units of the
/// machine epsilon eps = 2^-23.
///
/// The position is computed in double and rounded once, and so is the origin. Each rounding moves
/// it by at most eps/2 of the largest coordinate M in each of three directions. Together this is
/// sqrt(3) eps M, which `kRounding` covers. The stored edges are also rounded once, by eps/2 of
/// their length.
///
/// A ray that leaves the origin o must be on the right side of the triangle in Embree's float
/// arithmetic. Embree decides by the sign of dot(v0 - o, e0 x e1), with vertices relative to o. The
/// vertices are at most the longest edge L away. The roundings of the vertices (eps/2), of the two
/// edges and their cross product (about 10 eps/2 together) and of the dot product (3 eps/2) change
/// the distance by about 7 eps L, unless the triangle's largest angle approaches 180 degrees.
/// `kArithmetic` is the factor of the 1-norms of two edges. The sum of these norms is at least L,
/// and typically 2 L or more.
constexpr float kEpsilon = std::numeric_limits<float>::epsilon();
constexpr float kRounding = 2;
constexpr float kArithmetic = 8;

float largest(Vec3 v) {
  return max_component(abs(v));
}

/// Returns the shortest step that moves the point of weights `b` at least `margin` away from every
/// edge. In a narrower triangle the distance is only half the inradius. Points with this distance
/// form a smaller triangle, each corner of which lies on the way to the center of the inscribed
/// circle. The step leads to the nearest point on its boundary.
[[gnu::noinline, gnu::cold]] Vec3 step_off_edges(const TriangleFacts& f,
                                                 const std::array<float, 3>& b, float margin) {
  const Vec3 e1 = f.edge1, e2 = f.edge2;
  const float double_area = length(cross(e1, e2));
  const std::array<Vec3, 3> corners{Vec3{}, e1, e2};  // relative to vertex 0
  const std::array<float, 3> lengths{length(e2 - e1), length(e2), length(e1)};  // opposite edges
  const float perimeter = lengths[0] + lengths[1] + lengths[2];
  const auto distance = [&](std::size_t i) { return b[i] * double_area / lengths[i]; };
  std::size_t nearest = distance(1) < distance(0) ? 1 : 0;
  if (distance(2) < distance(nearest)) nearest = 2;
  const float kept = std::min(margin, 0.5f * double_area / perimeter);
  if (distance(nearest) >= kept) return {};

  const Vec3 center = (lengths[1] * e1 + lengths[2] * e2) / perimeter;
  const float share = kept * perimeter / double_area;
  const auto inner = [&](std::size_t i) { return corners[i] + share * (center - corners[i]); };
  const Vec3 point = b[1] * e1 + b[2] * e2;
  const Vec3 from = inner((nearest + 1) % 3), edge = inner((nearest + 2) % 3) - from;
  const float along = dot(point - from, edge) / length_squared(edge);
  return from + std::clamp(along, 0.0f, 1.0f) * edge - point;
}

/// Returns the vector at an offset within facts, followed by the float after it.
inline Double4 widened_member(const TriangleFacts& f, std::size_t offset) {
  static_assert(offsetof(TriangleFacts, edge2) + sizeof(Float4) <= sizeof(TriangleFacts));
  Float4 four;
  std::memcpy(&four, reinterpret_cast<const std::byte*>(&f) + offset, sizeof four);
  return widened(four);
}

/// Returns the position of the weights `b`, or the nearest position that is at least `margin` times
/// the triangle's error away from the edges.
inline Point3 position_at(const TriangleFacts& f, const std::array<float, 3>& b, float margin) {
  // Each product is exact, because it has at most 48 of the 53 digits of a double. Fused operations
  // therefore give the same bits.
  const Float4 sum = rounded(widened_member(f, offsetof(TriangleFacts, origin)) +
                             (double{b[1]} * widened_member(f, offsetof(TriangleFacts, edge1)) +
                              double{b[2]} * widened_member(f, offsetof(TriangleFacts, edge2))));
  const Point3 position{sum[0], sum[1], sum[2]};
  if (!(std::min(b[0], std::min(b[1], b[2])) < margin * f.edge_weight)) return position;
  return position + step_off_edges(f, b, margin * f.error);
}

Frame shading_frame(Vec3 interpolated, Vec3 normal) {
  const float side = dot(interpolated, normal);
  const float size = length(interpolated);
  const bool usable = side != 0 && size > 0 && std::isfinite(size);
  if (!usable) return Frame::from_normal(normal);
  return Frame::from_normal(std::copysign(1 / size, side) * interpolated);
}

/// Returns TriangleMesh::surface_point() for a triangle with these facts.
inline SurfacePoint point_on(const TriangleMesh& mesh, const TriangleFacts& f,
                             std::uint32_t triangle, float b1, float b2) {
  const float b0 = 1 - b1 - b2;
  SurfacePoint point;
  point.position = position_at(f, {b0, b1, b2}, kEdgeMargin);
  point.normal = f.normal;
  point.error = f.error;
  point.primitive = triangle;
  point.uv = {b1, b2};
  const std::vector<Vec3>& normals = mesh.normals;
  const std::vector<Vec2>& uvs = mesh.uvs;
  if (normals.empty() && uvs.empty()) {
    point.shading = Frame::from_normal(f.normal);
    return point;
  }
  const auto [i0, i1, i2] = mesh.triangles[triangle];
  point.shading =
      normals.empty()
          ? Frame::from_normal(f.normal)
          : shading_frame(b0 * normals[i0] + b1 * normals[i1] + b2 * normals[i2], f.normal);
  if (!uvs.empty()) point.uv = b0 * uvs[i0] + b1 * uvs[i1] + b2 * uvs[i2];
  return point;
}

}  // namespace

TriangleFacts TriangleMesh::facts_of(std::uint32_t triangle) const {
  const auto [i0, i1, i2] = triangles[triangle];
  const Point3 p0 = positions[i0], p1 = positions[i1], p2 = positions[i2];
  const Vec3d origin(p0);
  const Vec3d e1 = Vec3d(p1) - origin, e2 = Vec3d(p2) - origin;
  const Vec3d area_normal = cross(e1, e2);
  const double double_area = length(area_normal);

  TriangleFacts record;
  record.origin = p0;
  record.edge1 = to_float(e1);
  record.edge2 = to_float(e2);
  record.normal = to_float((1 / double_area) * area_normal);
  const float coordinate = std::max(largest(p0), std::max(largest(p1), largest(p2)));
  const float edge_sum = sum(abs(record.edge1)) + sum(abs(record.edge2));
  record.error = kEpsilon * (kRounding * coordinate + kArithmetic * edge_sum);
  // `edge_sum` is at least the longest edge, so no point close to an edge is missed. It is seldom
  // much longer, so few other points are taken for close ones.
  record.edge_weight = record.error * edge_sum / static_cast<float>(double_area);
  return record;
}

void TriangleMesh::precompute() {
  facts.clear();
  facts.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) facts.push_back(facts_of(i));
}

Point3 TriangleMesh::position_off_edges(std::uint32_t triangle, float b1, float b2,
                                        float margin) const {
  const TriangleFacts f = facts.empty() ? facts_of(triangle) : facts[triangle];
  return position_at(f, {1 - b1 - b2, b1, b2}, margin / f.error);
}

SurfacePoint TriangleMesh::surface_point(std::uint32_t triangle, float b1, float b2) const {
  if (facts.empty()) [[unlikely]]
    return point_on(*this, facts_of(triangle), triangle, b1, b2);
  return point_on(*this, facts[triangle], triangle, b1, b2);
}

UvTangents TriangleMesh::uv_tangents(std::uint32_t triangle) const {
  const auto [i0, i1, i2] = triangles[triangle];
  const Vec3d origin(positions[i0]);
  const Vec3d e1 = Vec3d(positions[i1]) - origin, e2 = Vec3d(positions[i2]) - origin;
  if (uvs.empty()) return {to_float(e1), to_float(e2)};  // the coordinates are the edges' weights
  const double u1 = double{uvs[i1].x} - uvs[i0].x, v1 = double{uvs[i1].y} - uvs[i0].y;
  const double u2 = double{uvs[i2].x} - uvs[i0].x, v2 = double{uvs[i2].y} - uvs[i0].y;
  const double determinant = u1 * v2 - u2 * v1;
  const UvTangents found{to_float((1 / determinant) * (v2 * e1 - v1 * e2)),
                         to_float((1 / determinant) * (u1 * e2 - u2 * e1))};
  return is_finite(found.du) && is_finite(found.dv) ? found : UvTangents{};
}

float TriangleMesh::area(std::uint32_t triangle) const {
  const auto [i0, i1, i2] = triangles[triangle];
  const Vec3d origin(positions[i0]);
  const Vec3d e1 = Vec3d(positions[i1]) - origin, e2 = Vec3d(positions[i2]) - origin;
  return static_cast<float>(0.5 * length(cross(e1, e2)));
}

Bounds3 TriangleMesh::bounds() const {
  Bounds3 box;
  for (const Point3& p : positions) box.add(p);
  return box;
}

SurfacePoint Shape::surface_point(const Ray&, const PrimitiveHit& hit) const {
  return mesh()->surface_point(hit.primitive, hit.coordinates.x, hit.coordinates.y);
}

UvTangents Shape::uv_tangents(const SurfacePoint& point) const {
  const TriangleMesh* triangles = mesh();
  return triangles != nullptr ? triangles->uv_tangents(point.primitive) : UvTangents{};
}

ShapeSample Shape::sample_from(Point3 from, Vec2 u) const {
  ShapeSample s = sample(u);
  s.pdf = solid_angle_pdf_from_area(s.pdf, from, s.point.position, s.point.normal);
  return s;
}

float Shape::pdf_from(Point3 from, const SurfacePoint& point) const {
  return solid_angle_pdf_from_area(1 / area(), from, point.position, point.normal);
}

}  // namespace pharos
