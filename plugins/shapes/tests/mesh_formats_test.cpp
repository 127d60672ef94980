// The same shape in every format must give the same mesh.

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../mesh_file.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

/// A wave over 9 x 9 points, whose coordinates have few digits.
TriangleMesh wave() {
  constexpr std::uint32_t n = 9;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const float x = static_cast<float>(i % n) / 8, y = static_cast<float>(i / n) / 8;
    mesh.positions.push_back({x, y, x * (1 - x) * y});
    mesh.normals.push_back({0.75f, -0.5f * y, 0.5f});
    mesh.uvs.push_back({x, 0.25f * y});
    if (i % n + 1 == n || i / n + 1 == n) continue;
    mesh.triangles.push_back({i, i + 1, i + n + 1});
    mesh.triangles.push_back({i, i + n + 1, i + n});
  }
  return mesh;
}

std::string spaced(std::initializer_list<float> numbers) {
  std::ostringstream text;
  text.precision(9);
  for (const float v : numbers) text << ' ' << v;
  return text.str();
}

std::string obj(const TriangleMesh& mesh) {
  std::string text = "o wave\n";
  for (const Vec3 p : mesh.positions) text += "v" + spaced({p.x, p.y, p.z}) + "\n";
  for (const Vec3 n : mesh.normals) text += "vn" + spaced({n.x, n.y, n.z}) + "\n";
  for (const Vec2 uv : mesh.uvs) text += "vt" + spaced({uv.x, uv.y}) + "\n";
  for (const auto& triangle : mesh.triangles) {
    text += "f";
    for (const std::uint32_t i : triangle) {
      const std::string k = std::to_string(i + 1);
      text += " " + k + "/" + k + "/" + k;
    }
    text += "\n";
  }
  return text;
}

std::string ply(const TriangleMesh& mesh) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.positions.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "u", "v"}) {
    text += std::string("property float ") + name + "\n";
  }
  text += "element face " + std::to_string(mesh.triangles.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i], n = mesh.normals[i];
    text += spaced({p.x, p.y, p.z, n.x, n.y, n.z, mesh.uvs[i].x, mesh.uvs[i].y}) + "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
  return text;
}

template <class Write>
std::string facets(const TriangleMesh& mesh, const Write& write) {
  std::string text;
  for (const auto& [a, b, c] : mesh.triangles) {
    text += write(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
  }
  return text;
}

std::string text_stl(const TriangleMesh& mesh) {
  const auto vertex = [](Point3 p) { return "vertex" + spaced({p.x, p.y, p.z}) + "\n"; };
  return "solid wave\n" +
         facets(mesh,
                [&](Point3 a, Point3 b, Point3 c) {
                  return "facet normal 0 0 1\nouter loop\n" + vertex(a) + vertex(b) + vertex(c) +
                         "endloop\nendfacet\n";
                }) +
         "endsolid wave\n";
}

std::string binary_stl(const TriangleMesh& mesh) {
  return std::string(80, ' ') + test::little_endian(mesh.triangles.size()) +
         facets(mesh, [](Point3 a, Point3 b, Point3 c) {
           return test::bytes_of<Vec3>({{0, 0, 1}, a, b, c}) + std::string(2, '\0');
         });
}

/// Returns JSON whose buffer is at `uri`, and the buffer.
std::pair<std::string, std::string> gltf_parts(TriangleMesh mesh, const std::string& uri) {
  for (Vec2& uv : mesh.uvs) uv.y = 1 - uv.y;
  const std::array<std::string, 4> views{test::bytes_of(mesh.positions),
                                         test::bytes_of(mesh.normals), test::bytes_of(mesh.uvs),
                                         test::bytes_of(mesh.triangles)};
  std::string bytes, view_list, accessors;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::string separator = i > 0 ? ", " : "";
    const std::size_t count = i < 3 ? mesh.positions.size() : 3 * mesh.triangles.size();
    view_list += separator + "{\"buffer\": 0, \"byteOffset\": " + std::to_string(bytes.size()) +
                 ", \"byteLength\": " + std::to_string(views[i].size()) + "}";
    accessors += separator + "{\"bufferView\": " + std::to_string(i) +
                 ", \"count\": " + std::to_string(count) +
                 ", \"componentType\": " + (i < 3 ? "5126" : "5125") + ", \"type\": \"" +
                 (i < 2   ? "VEC3"
                  : i < 3 ? "VEC2"
                          : "SCALAR") +
                 "\"}";
    bytes += views[i];
  }
  return {R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"indices": 3,
      "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}]}],
    "accessors": [)" +
              accessors + "], \"bufferViews\": [" + view_list + "], \"buffers\": [{" +
              (uri.empty() ? "" : "\"uri\": \"" + uri + "\", ") +
              "\"byteLength\": " + std::to_string(bytes.size()) + "}]}",
          bytes};
}

std::string gltf(const TriangleMesh& mesh) {
  return gltf_parts(mesh, test::data_uri(gltf_parts(mesh, "").second)).first;
}

std::string glb(const TriangleMesh& mesh) {
  const auto [json, bytes] = gltf_parts(mesh, "");
  return test::glb(json, bytes);
}

TEST_CASE("one shape in every format is the same mesh") {
  const TriangleMesh mesh = wave();
  const test::TemporaryFolder folder;
  const std::map<std::string, std::string> files{
      {"a.obj", obj(mesh)},        {"a.ply", ply(mesh)},   {"a.STL", text_stl(mesh)},
      {"b.stl", binary_stl(mesh)}, {"a.gltf", gltf(mesh)}, {"a.glb", glb(mesh)}};
  for (const auto& file : files) {
    const std::string& name = file.first;
    INFO(name);
    const TriangleMesh read = read_mesh_file({.file = folder.write(name, file.second)});
    const bool is_stl = name.ends_with("stl") || name.ends_with("STL");
    CHECK(read.normals.empty() == is_stl);
    CHECK(read.uvs.empty() == is_stl);
    CHECK(read.positions.size() == mesh.positions.size());
    REQUIRE(read.triangles.size() == mesh.triangles.size());
    int different = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[i][k], b = read.triangles[i][k];
        const bool same =
            read.positions[b] == mesh.positions[a] &&
            (is_stl || (read.uvs[b] == mesh.uvs[a] &&
                        length(normalize(read.normals[b]) - normalize(mesh.normals[a])) < 1e-6f));
        different += same ? 0 : 1;
      }
    }
    CHECK(different == 0);
  }
}

}  // namespace
}  // namespace pharos
