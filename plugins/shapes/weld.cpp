#include "weld.h"

#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace pharos {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

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
    std::size_t slot = hash(vertex) & (slots_.size() - 1);
    for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
      if (same(vertex, slots_[slot])) return slots_[slot];
    }
    return slots_[slot] = add(vertex);
  }

  std::uint64_t hash(std::uint32_t vertex) const {
    std::uint64_t h = 0;
    const auto mix = [&h](float v) {
      h = (h ^ std::bit_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 32;
    };
    const auto mix_all = [&mix](Vec3 v) { mix(v.x), mix(v.y), mix(v.z); };
    mix_all(mesh_.positions[vertex]);
    if (!mesh_.normals.empty()) mix_all(mesh_.normals[vertex]);
    if (!mesh_.uvs.empty()) mix(mesh_.uvs[vertex].x), mix(mesh_.uvs[vertex].y);
    return h;
  }

  bool same(std::uint32_t vertex, std::uint32_t known) const {
    return mesh_.positions[vertex] == result_.positions[known] &&
           (mesh_.normals.empty() || mesh_.normals[vertex] == result_.normals[known]) &&
           (mesh_.uvs.empty() || mesh_.uvs[vertex] == result_.uvs[known]);
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
