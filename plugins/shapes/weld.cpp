#include "weld.h"

#include <array>
#include <bit>
#include <utility>
#include <vector>

#include <pharos/core/error.h>

#include "vertex_table.h"

namespace pharos {
namespace {

/// The position, normal and texture coordinates of a vertex; zeros if the mesh has none.
using Numbers = std::array<float, 8>;
using Bits = VertexTable<8>::Words;

Bits bits_of(const TriangleMesh& mesh, std::uint32_t vertex) {
  const Point3 p = mesh.positions[vertex];
  const Vec3 n = mesh.normals.empty() ? Vec3{} : mesh.normals[vertex];
  const Vec2 uv = mesh.uvs.empty() ? Vec2{} : mesh.uvs[vertex];
  return std::bit_cast<Bits>(Numbers{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y});
}

void check_sizes(const TriangleMesh& mesh) {
  const auto fits = [&](const auto& list) {
    return list.empty() || list.size() == mesh.positions.size();
  };
  if (!fits(mesh.normals) || !fits(mesh.uvs)) {
    throw InputError("its vertices, normals and texture coordinates differ in number");
  }
}

/// Returns a mesh of these vertices, with the attributes that `like` has.
TriangleMesh mesh_of(const std::vector<Bits>& vertices, const TriangleMesh& like) {
  TriangleMesh mesh;
  for (const Bits& vertex : vertices) {
    const auto v = std::bit_cast<Numbers>(vertex);
    mesh.positions.push_back({v[0], v[1], v[2]});
    if (!like.normals.empty()) mesh.normals.push_back({v[3], v[4], v[5]});
    if (!like.uvs.empty()) mesh.uvs.push_back({v[6], v[7]});
  }
  return mesh;
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh) {
  check_sizes(mesh);
  constexpr std::uint32_t kNotYet = ~std::uint32_t{0};
  VertexTable<8> table(mesh.positions.size());
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kNotYet);  // in the table, by vertex
  std::vector<std::array<std::uint32_t, 3>> triangles = mesh.triangles;
  for (std::array<std::uint32_t, 3>& triangle : triangles) {
    for (std::uint32_t& vertex : triangle) {
      std::uint32_t& number = numbers[vertex];
      if (number == kNotYet) number = table.number_of(bits_of(mesh, vertex));
      vertex = number;
    }
  }
  TriangleMesh result = mesh_of(table.vertices(), mesh);
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace pharos
