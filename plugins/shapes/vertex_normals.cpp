#include "vertex_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "double3.h"

namespace pharos {
namespace {

/// A bound on the effect of rounding to single precision: four rounding steps. For the height of a
/// triangle it is relative to its coordinates, for a sum of normals relative to its terms.
constexpr double kRounding = 0x1p-22;

using Corners = std::array<Double3, 3>;

Corners corners_of(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const auto [a, b, c] = triangle;
  return {Double3(mesh.positions[a]), Double3(mesh.positions[b]), Double3(mesh.positions[c])};
}

/// Returns the unit normal; empty for a triangle without area.
std::optional<Double3> facet_normal(const Corners& p) {
  const Double3 doubled = cross(p[1] - p[0], p[2] - p[0]);
  if (!(length(doubled) > 0)) return std::nullopt;
  return normalize(doubled);
}

double largest_coordinate(const Corners& p) {
  double largest = 0;
  for (const Double3& corner : p) {
    largest = std::max({largest, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
  }
  return largest;
}

/// Returns the angles [rad] of a triangle; empty if its normal depends on rounding alone.
std::optional<std::array<double, 3>> angles_of(const Corners& p) {
  const std::array<Double3, 3> edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  const double doubled_area = length(cross(edges[0], edges[1]));
  const double longest = std::max({length(edges[0]), length(edges[1]), length(edges[2])});
  if (!(doubled_area > kRounding * largest_coordinate(p) * longest)) return std::nullopt;
  std::array<double, 3> angles;
  for (std::size_t i = 0; i < 3; ++i) {
    angles[i] = std::atan2(doubled_area, -dot(edges[i], edges[(i + 2) % 3]));
  }
  return angles;
}

/// The weighted normals of the triangles around a vertex.
struct WeightedNormals {
  Double3 sum;
  double weight = 0;

  void add(Double3 normal, double more) {
    sum = sum + more * normal;
    weight += more;
  }
  /// Returns zero if the normals cancel out or there are none.
  Vec3 mean() const { return length(sum) > kRounding * weight ? Vec3(normalize(sum)) : Vec3{}; }
};

std::vector<WeightedNormals> normals_around_vertices(const TriangleMesh& mesh) {
  std::vector<WeightedNormals> around(mesh.positions.size());
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    const Corners corners = corners_of(mesh, triangle);
    const std::optional<std::array<double, 3>> angles = angles_of(corners);
    if (!angles) continue;
    const Double3 normal = *facet_normal(corners);
    for (std::size_t i = 0; i < 3; ++i) around[triangle[i]].add(normal, (*angles)[i]);
  }
  return around;
}

std::uint32_t add_copy(TriangleMesh& mesh, std::uint32_t vertex, Vec3 normal) {
  mesh.positions.push_back(mesh.positions[vertex]);
  mesh.normals.push_back(normal);
  if (!mesh.uvs.empty()) mesh.uvs.push_back(mesh.uvs[vertex]);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// Creates new vertices for the corners whose vertex has no normal.
void add_facet_normals(TriangleMesh& mesh) {
  for (std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    const std::optional<Double3> normal = facet_normal(corners_of(mesh, triangle));
    if (!normal) continue;
    for (std::uint32_t& vertex : triangle) {
      if (mesh.normals[vertex] == Vec3{}) vertex = add_copy(mesh, vertex, Vec3(*normal));
    }
  }
}

}  // namespace

void add_vertex_normals(TriangleMesh& mesh) {
  mesh.normals.resize(mesh.positions.size());
  const auto lacks_normal = [](Vec3 normal) { return normal == Vec3{}; };
  if (std::none_of(mesh.normals.begin(), mesh.normals.end(), lacks_normal)) return;
  const std::vector<WeightedNormals> around = normals_around_vertices(mesh);
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (lacks_normal(mesh.normals[i])) mesh.normals[i] = around[i].mean();
  }
  add_facet_normals(mesh);
}

}  // namespace pharos
