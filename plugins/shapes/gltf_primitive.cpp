#include "gltf_primitive.h"

#include <utility>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "vertex_table.h"

namespace pharos {
namespace {

std::optional<GltfAccessor> accessor_if_any(GltfFile& file, const GltfValue& owner, const char* key,
                                            std::string_view type) {
  if (!owner.has(key)) return std::nullopt;
  return GltfAccessor(file, owner.member(key), type);
}

}  // namespace

GltfPrimitive::Mode GltfPrimitive::mode_of(const GltfValue& primitive) {
  const std::uint64_t mode = primitive.whole("mode", static_cast<std::uint64_t>(Mode::triangles));
  if (mode > static_cast<std::uint64_t>(Mode::fan)) {
    primitive.fail(fmt::format("has mode {}; the last one is 6", mode));
  }
  return static_cast<Mode>(mode);
}

GltfPrimitive::GltfPrimitive(GltfFile& file, const GltfValue& primitive)
    : place_(primitive.place()),
      mode_(mode_of(primitive)),
      positions_(file, primitive.member("attributes").member("POSITION"), "VEC3"),
      normals_(accessor_if_any(file, primitive.member("attributes"), "NORMAL", "VEC3")),
      uvs_(accessor_if_any(file, primitive.member("attributes"), "TEXCOORD_0", "VEC2")),
      indices_(accessor_if_any(file, primitive, "indices", "SCALAR")) {
  check();
}

void GltfPrimitive::fail(const std::string& what) const {
  throw InputError(place_ + " " + what);
}

void GltfPrimitive::check() const {
  const auto check_size = [&](const std::optional<GltfAccessor>& accessor, std::string_view what) {
    if (!accessor || accessor->size() == positions_.size()) return;
    fail(fmt::format("has {} {} for {} vertices", accessor->size(), what, positions_.size()));
  };
  check_size(normals_, "normals");
  check_size(uvs_, "texture coordinates");
  if (indices_ && !indices_->is_unsigned()) fail("has indices that are no unsigned integers");
  if (mode_ == Mode::triangles && corner_count() % 3 != 0) {
    fail(fmt::format("has {} corners of triangles, no multiple of three", corner_count()));
  }
}

std::uint64_t GltfPrimitive::triangle_count() const {
  if (mode_ == Mode::triangles) return corner_count() / 3;
  const bool chained = mode_ == Mode::strip || mode_ == Mode::fan;
  return chained && corner_count() >= 3 ? corner_count() - 2 : 0;
}

MeshExtent GltfPrimitive::extent() const {
  const auto triangles = static_cast<double>(triangle_count());
  return {.triangles = triangles,
          .vertices = takes_all_vertices() ? static_cast<double>(positions_.size()) : 3 * triangles,
          .attributes = {.normals = normals_.has_value(), .uvs = uvs_.has_value()}};
}

std::array<std::uint32_t, 3> GltfPrimitive::corners(std::uint64_t triangle) const {
  const std::uint64_t i = triangle;
  std::array<std::uint64_t, 3> corners{i, i + 1, i + 2};
  if (mode_ == Mode::triangles) corners = {3 * i, 3 * i + 1, 3 * i + 2};
  if (mode_ == Mode::fan) corners[0] = 0;
  if (mode_ == Mode::strip && i % 2 == 1) std::swap(corners[1], corners[2]);
  std::array<std::uint32_t, 3> vertices;
  for (std::size_t k = 0; k < 3; ++k) {
    vertices[k] = indices_ ? indices_->index(corners[k]) : static_cast<std::uint32_t>(corners[k]);
    if (vertices[k] >= positions_.size()) {
      fail(fmt::format("names vertex {}; it has {}", vertices[k], positions_.size()));
    }
  }
  return vertices;
}

void GltfPrimitive::append_to(TriangleMesh& mesh, const NodeTransform& to_root,
                              VertexAttributes attributes) const {
  const bool all_vertices = takes_all_vertices();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  VertexTable<1> named(all_vertices ? 0 : 3 * triangle_count());
  for (std::uint64_t i = 0; i < triangle_count(); ++i) {
    std::array<std::uint32_t, 3> vertices = corners(i);
    for (std::uint32_t& vertex : vertices) {
      vertex = first + (all_vertices ? vertex : named.number_of({vertex}));
    }
    if (to_root.mirrors()) std::swap(vertices[1], vertices[2]);
    mesh.triangles.push_back(vertices);
  }
  const auto append = [&](std::uint32_t vertex) {
    append_vertex(mesh, vertex, to_root, attributes);
  };
  for (std::uint32_t i = 0; all_vertices && i < positions_.size(); ++i) append(i);
  for (const auto& [vertex] : named.vertices()) append(vertex);
}

void GltfPrimitive::append_vertex(TriangleMesh& mesh, std::uint32_t vertex,
                                  const NodeTransform& to_root, VertexAttributes attributes) const {
  const Point3 position = to_root.point(positions_.vector(vertex));
  const Vec3 raw_normal = normals_ ? normals_->vector(vertex) : Vec3{};
  const Vec3 normal = to_root.normal(raw_normal);
  const Vec3 uv = uvs_ ? uvs_->vector(vertex) : Vec3{0, 1, 0};
  const bool finite =
      is_finite(position) && is_finite(raw_normal) && is_finite(normal) && is_finite(uv);
  if (!finite) fail(fmt::format("has vertex {}, which is not finite", vertex));
  mesh.positions.push_back(position);
  if (attributes.normals) mesh.normals.push_back(normal);
  if (attributes.uvs) mesh.uvs.push_back({uv.x, 1 - uv.y});  // in files v runs from the top
}

}  // namespace pharos
