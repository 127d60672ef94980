#include "pbrt_mesh.h"

#include <charconv>
#include <pbrt_syntax/lexer.h>
#include <pbrt_syntax/parameters.h>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "triangle_shape.h"

namespace pharos {
namespace {

using pbrt::Parameter, pbrt::Parameters;

/// Parses "line:column".
std::pair<int, int> place_of(const std::string& part) {
  int line = 0, column = 0;
  const char* const end = part.data() + part.size();
  const auto first = std::from_chars(part.data(), end, line);
  if (first.ec == std::errc{} && first.ptr != end && *first.ptr == ':') {
    const auto second = std::from_chars(first.ptr + 1, end, column);
    if (second.ec == std::errc{} && second.ptr == end && line > 0 && column > 0) {
      return {line, column};
    }
  }
  throw InputError(fmt::format(
      "the part of a .pbrt file is the line and column of a Shape, such as '12:1', found '{}'",
      one_line(part, 60)));
}

/// Returns the parameter of this name and type, or null.
const Parameter* typed(const Parameters& parameters, std::string_view name, std::string_view type) {
  const Parameter* p = pbrt::find(parameters, name);
  if (p != nullptr && p->type != type) {
    throw InputError(p->where,
                     fmt::format("'{}' must be of type {}, found {}", name, type, p->type));
  }
  return p;
}

std::vector<Vec3> triples(const Parameter* p) {
  std::vector<Vec3> all;
  if (p == nullptr) return all;
  all.reserve(p->numbers.size() / 3);
  for (std::size_t i = 0; i < p->numbers.size(); i += 3) {
    const auto at = [&](std::size_t k) { return static_cast<float>(p->numbers[i + k]); };
    all.push_back({at(0), at(1), at(2)});
  }
  return all;
}

std::vector<Vec2> pairs(const Parameter* p) {
  std::vector<Vec2> all;
  if (p == nullptr) return all;
  all.reserve(p->numbers.size() / 2);
  for (std::size_t i = 0; i < p->numbers.size(); i += 2) {
    all.push_back({static_cast<float>(p->numbers[i]), static_cast<float>(p->numbers[i + 1])});
  }
  return all;
}

/// Returns the indices of the vertices, `corners` for each face. Without the parameter the mesh is
/// a single face.
std::vector<std::uint32_t> face_indices(const Parameter* p, std::size_t vertices,
                                        std::size_t corners, const Location& where) {
  std::vector<std::uint32_t> all;
  if (p == nullptr) {
    if (vertices != corners) throw InputError(where, "'indices' is missing");
    for (std::uint32_t i = 0; i < corners; ++i) all.push_back(i);
    return all;
  }
  if (p->numbers.size() % corners != 0) {
    throw InputError(p->where, fmt::format("'indices' has {} numbers, not a multiple of {}",
                                           p->numbers.size(), corners));
  }
  check_triangle_count(static_cast<double>(p->numbers.size()) / 3, "it");
  all.reserve(p->numbers.size());
  for (const double index : p->numbers) {
    if (index < 0 || index >= static_cast<double>(vertices)) {
      throw InputError(p->where, fmt::format("the index {} is out of range: there are {} vertices",
                                             index, vertices));
    }
    all.push_back(static_cast<std::uint32_t>(index));
  }
  return all;
}

/// Checks that a list of the vertices is as long as the list of positions.
template <class T>
void check_length(const std::vector<T>& list, std::size_t vertices, const Parameter* p) {
  if (list.empty() || list.size() == vertices) return;
  throw InputError(
      p->where, fmt::format("'{}' has {} values for {} vertices", p->name, list.size(), vertices));
}

/// Returns the mesh with four vertices of its own for each patch, where the texture coordinates of
/// a patch are (0, 0), (1, 0), (0, 1) and (1, 1).
TriangleMesh with_patch_uvs(const TriangleMesh& mesh, std::vector<std::uint32_t>& indices) {
  TriangleMesh split;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    split.positions.push_back(mesh.positions[indices[i]]);
    if (!mesh.normals.empty()) split.normals.push_back(mesh.normals[indices[i]]);
    split.uvs.push_back({static_cast<float>(i & 1), static_cast<float>((i >> 1) & 1)});
    indices[i] = static_cast<std::uint32_t>(i);
  }
  return split;
}

/// Turns triangles around whose normals in the file lie on the other side: in pbrt, these decide
/// which side is outside.
void follow_normals(TriangleMesh& mesh) {
  if (mesh.normals.empty()) return;
  for (auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal =
        cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    if (dot(normal, mesh.normals[a] + mesh.normals[b] + mesh.normals[c]) < 0) std::swap(b, c);
  }
}

TriangleMesh read_mesh(const std::string& type, const Parameters& parameters,
                       const Location& where) {
  const bool is_bilinear = type == "bilinearmesh", is_control = type == "loopsubdiv";
  const Parameter* positions = typed(parameters, "P", "point3");
  const Parameter* normals = is_control ? nullptr : typed(parameters, "N", "normal");
  const Parameter* uvs = is_control ? nullptr : typed(parameters, "uv", "point2");
  if (positions == nullptr) throw InputError(where, "'P' is missing");
  TriangleMesh mesh{triples(positions), triples(normals), pairs(uvs), {}, {}};
  const std::size_t vertices = mesh.positions.size(), corners = is_bilinear ? 4 : 3;
  check_length(mesh.normals, vertices, normals);
  check_length(mesh.uvs, vertices, uvs);
  std::vector<std::uint32_t> indices =
      face_indices(typed(parameters, "indices", "integer"), vertices, corners, where);
  if (is_bilinear && mesh.uvs.empty()) mesh = with_patch_uvs(mesh, indices);
  mesh.triangles.reserve(indices.size() / corners * (corners - 2));
  for (std::size_t i = 0; i < indices.size(); i += corners) {
    if (!is_bilinear) {
      mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
      continue;
    }
    // The corners of a patch are (0, 0), (1, 0), (0, 1) and (1, 1).
    mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 3]});
    mesh.triangles.push_back({indices[i], indices[i + 3], indices[i + 2]});
  }
  follow_normals(mesh);
  return mesh;
}

}  // namespace

TriangleMesh read_pbrt_mesh(const MeshSource& source) {
  const auto [line, column] = place_of(source.part);
  pbrt::Lexer lexer(source.bytes, source.path.string());
  const Location where{source.path.string(), line, column};
  if (!lexer.seek(line, column) || lexer.next().raw != "Shape") {
    throw InputError(where, "there is no Shape here");
  }
  const std::string type = lexer.text("the type of the shape");
  if (type != "trianglemesh" && type != "bilinearmesh" && type != "loopsubdiv") {
    throw InputError(where, fmt::format("the shape '{}' has no triangles", one_line(type, 60)));
  }
  return read_mesh(type, pbrt::read_parameters(lexer), where);
}

}  // namespace pharos
