#include "weld.h"

#include <array>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include <pharos/core/error.h>

namespace pharos {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Position, normal and texture coordinates of a vertex; zeros where the mesh has none.
using VertexBits = std::array<std::uint32_t, 8>;

VertexBits bits_of(const TriangleMesh& mesh, std::uint32_t vertex) {
  const Point3 p = mesh.positions[vertex];
  const Vec3 n = mesh.normals.empty() ? Vec3{} : mesh.normals[vertex];
  const Vec2 uv = mesh.uvs.empty() ? Vec2{} : mesh.uvs[vertex];
  return std::bit_cast<VertexBits>(std::array{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y});
}

std::uint64_t hash(const VertexBits& bits) {
  std::uint64_t h = 0;
  for (const std::uint32_t word : bits) {
    h = (h ^ word) * 0x9e3779b97f4a7c15u;
    h ^= h >> 32;
  }
  return h;
}

void check_sizes(const TriangleMesh& mesh) {
  const auto fits = [&](const auto& list) {
    return list.empty() || list.size() == mesh.positions.size();
  };
  if (!fits(mesh.normals) || !fits(mesh.uvs)) {
    throw InputError("its vertices, normals and texture coordinates differ in number");
  }
}

/// The vertices met so far, found by a hash of their bits.
class Welder {
 public:
  explicit Welder(const TriangleMesh& mesh)
      : mesh_(mesh),
        new_index_(mesh.positions.size(), kNone),
        slots_(std::bit_ceil(2 * mesh.positions.size() + 1), kNone) {}

  /// The vertex's index in the result, to which it is added if it is the first of its kind.
  std::uint32_t weld(std::uint32_t vertex) {
    std::uint32_t& index = new_index_[vertex];
    if (index == kNone) index = find_or_add(vertex);
    return index;
  }

  TriangleMesh take() { return std::move(result_); }

 private:
  /// Linear probing; the table is at most half full.
  std::uint32_t find_or_add(std::uint32_t vertex) {
    const VertexBits bits = bits_of(mesh_, vertex);
    std::size_t slot = hash(bits) & (slots_.size() - 1);
    for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
      if (bits_of(result_, slots_[slot]) == bits) return slots_[slot];
    }
    return slots_[slot] = add(vertex);
  }

  std::uint32_t add(std::uint32_t vertex) {
    result_.positions.push_back(mesh_.positions[vertex]);
    if (!mesh_.normals.empty()) result_.normals.push_back(mesh_.normals[vertex]);
    if (!mesh_.uvs.empty()) result_.uvs.push_back(mesh_.uvs[vertex]);
    return static_cast<std::uint32_t>(result_.positions.size() - 1);
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> new_index_;  ///< by vertex
  std::vector<std::uint32_t> slots_;      ///< indices into the result
  TriangleMesh result_;
};

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh) {
  check_sizes(mesh);
  Welder welder(mesh);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back({welder.weld(a), welder.weld(b), welder.weld(c)});
  }
  TriangleMesh result = welder.take();
  result.triangles = std::move(triangles);
  return result;
}

}  // namespace pharos
