// The buffers, accessors, primitives and nodes that glTF allows.

#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../gltf_file.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

TriangleMesh read(const std::string& bytes, const std::string& part = "") {
  return read_gltf({"file.gltf", bytes, part});
}

/// Reads the triangle with a change in its JSON.
TriangleMesh changed(const std::string& what, const std::string& by) {
  return read(test::glb(test::with(test::kGltfTriangle, what, by), test::triangle_bytes()));
}

std::string refusal(const std::string& bytes) {
  return test::input_error([&] { read(bytes); });
}

using Corners = std::array<std::uint32_t, 3>;

TEST_CASE("glTF: numbers of all types mean what glTF says") {
  // The three numbers of vertex i begin at byte 3 + 16 i.
  const auto positions = [](int type, bool normalized, const std::string& bytes) {
    const std::string json = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "type": "VEC3", "count": 3.0, "byteOffset": 2,
        "componentType": )" + std::to_string(type) +
                             R"(, "normalized": )" + (normalized ? "true" : "false") + R"(}],
      "bufferViews": [{"buffer": 0, "byteOffset": 1, "byteStride": 16, "byteLength": )" +
                             std::to_string(bytes.size() - 1) + R"(}],
      "buffers": [{"byteLength": )" +
                             std::to_string(bytes.size()) + "}]}";
    return read(test::glb(json, bytes)).positions;
  };
  const auto rows = [](auto one, auto two, auto three) {
    std::string bytes = "...";
    for (int i = 0; i < 3; ++i) {
      bytes += test::bytes_of<decltype(one)>({one, two, three});
      if (i < 2) bytes.resize(3 + 16 * static_cast<std::size_t>(i + 1), '.');
    }
    return bytes;
  };
  using I8 = std::int8_t;
  using U8 = std::uint8_t;
  using I16 = std::int16_t;
  using U16 = std::uint16_t;
  using U32 = std::uint32_t;
  CHECK(positions(5120, false, rows(I8{-128}, I8{5}, I8{127}))[2] == Point3{-128, 5, 127});
  CHECK(positions(5120, true, rows(I8{-128}, I8{-127}, I8{127}))[1] == Point3{-1, -1, 1});
  CHECK(positions(5121, false, rows(U8{0}, U8{5}, U8{255}))[0] == Point3{0, 5, 255});
  CHECK(positions(5121, true, rows(U8{0}, U8{51}, U8{255}))[2] == Point3{0, 0.2f, 1});
  CHECK(positions(5122, false, rows(I16{-300}, I16{5}, I16{300}))[2] == Point3{-300, 5, 300});
  CHECK(positions(5122, true, rows(I16{-32768}, I16{0}, I16{32767}))[1] == Point3{-1, 0, 1});
  CHECK(positions(5123, false, rows(U16{0}, U16{5}, U16{65535}))[2] == Point3{0, 5, 65535});
  CHECK(positions(5123, true, rows(U16{0}, U16{13107}, U16{65535}))[1] == Point3{0, 0.2f, 1});
  CHECK(positions(5125, false, rows(U32{0}, U32{5}, U32{70000}))[0] == Point3{0, 5, 70000});
  CHECK(positions(5126, false, rows(-1.5f, 0.25f, 1e9f))[2] == Point3{-1.5f, 0.25f, 1e9f});
}

TEST_CASE("glTF: indices of one, two and four bytes, or none at all") {
  const std::string vertices = test::triangle_bytes().substr(0, 96);
  const auto triangles = [&](const std::string& type, const std::string& indices) {
    const std::string json = test::with(test::with(test::kGltfTriangle, "5123", type),
                                        R"("byteLength": 6)", R"("byteLength": 12)");
    std::string bytes = vertices + indices;
    bytes.resize(108);
    return read(test::glb(test::with(json, "104", "108"), bytes)).triangles;
  };
  const std::vector<Corners> expected{{2, 1, 0}};
  CHECK(triangles("5121", test::bytes_of<std::uint8_t>({2, 1, 0})) == expected);
  CHECK(triangles("5123", test::bytes_of<std::uint16_t>({2, 1, 0})) == expected);
  CHECK(triangles("5125", test::bytes_of<std::uint32_t>({2, 1, 0})) == expected);
  CHECK(changed(R"("indices": 3,)", "").triangles == std::vector<Corners>{{0, 1, 2}});
}

TEST_CASE("glTF: strips and fans turn the same way, points and lines are left out") {
  const auto triangles = [](const std::string& mode) {
    const std::string json = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"mode": )" +
                             mode + R"(, "attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 5}],
      "bufferViews": [{"buffer": 0, "byteLength": 60}], "buffers": [{"byteLength": 60}]})";
    return read(test::glb(json, test::bytes_of(std::vector<float>(15)))).triangles;
  };
  CHECK(triangles("5") == std::vector<Corners>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}});
  CHECK(triangles("6") == std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  for (const char* mode : {"0", "1", "2", "3"}) CHECK(triangles(mode).empty());
}

TEST_CASE("glTF: a primitive takes no more of a long list of vertices than it names") {
  const std::string json = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 5},
                  {"bufferView": 1, "type": "SCALAR", "componentType": 5121, "count": 3}],
    "bufferViews": [{"buffer": 0, "byteLength": 60},
                    {"buffer": 0, "byteOffset": 60, "byteLength": 3}],
    "buffers": [{"byteLength": 63}]})";
  const std::string positions =
      test::bytes_of<float>({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0});
  const TriangleMesh mesh = read(test::glb(json, positions + std::string("\4\1\2", 3)));
  REQUIRE(mesh.triangles.size() == 1);
  CHECK(mesh.positions == std::vector<Point3>{{4, 0, 0}, {1, 0, 0}, {2, 0, 0}});
}

TEST_CASE("glTF: nodes are scaled, then rotated, then moved; matrices stand column after column") {
  const float s = std::sqrt(0.5f);
  const auto corner = [](const std::string& node) {
    return changed(R"("mesh": 0)", R"("mesh": 0, )" + node).positions[1];
  };
  const auto check_near = [](Point3 a, Point3 b) {
    INFO(a.x, " ", a.y, " ", a.z);
    CHECK(length(a - b) < 1e-6f);
  };
  const std::string quarter = "[0, 0, " + std::to_string(s) + ", " + std::to_string(s) + "]";
  check_near(corner(R"("translation": [1, 2, 3], "scale": [2, 1, 1], "rotation": )" + quarter),
             {1, 4, 3});
  check_near(corner(R"("rotation": [0, 2, 0, 2])"), {0, 0, -1});  // about y, for any length
  check_near(corner(R"("rotation": [1, 0, 0, 1])"), {1, 0, 0});
  check_near(corner(R"("matrix": [0, 3, 0, 0,  -1, 0, 0, 0,  0, 0, 1, 0,  5, 6, 7, 1])"),
             {5, 9, 7});
}

TEST_CASE("glTF: without a default scene the first one counts, and only that") {
  const auto count = [](const std::string& what, const std::string& by) {
    return changed(what, by).triangles.size();
  };
  CHECK(count(R"("scene": 0,)", "") == 1);
  CHECK(count(R"([{"nodes": [0]}])", R"([{"nodes": [0]}, {"nodes": []}])") == 1);
  CHECK(count(R"("scene": 0,
  "scenes": [)",
              R"("scene": 1, "scenes": [{"nodes": [0]}, )") == 1);
  CHECK(count(R"("scenes": [)", R"("scenes": [{"nodes": []}, )") == 0);
}

TEST_CASE("glTF: a buffer is a chunk, base64 of any length, or a file beside") {
  const test::TemporaryFolder folder;
  folder.write("my buffer.bin", test::triangle_bytes() + "more");
  const auto with_uri = [](const std::string& uri) {
    return test::with(test::kGltfTriangle, R"({"byteLength": 104})",
                      R"({"byteLength": 104, "uri": ")" + uri + "\"}");
  };
  for (const std::string more : {"", "1", "12"}) {
    CHECK(read(with_uri(test::data_uri(test::triangle_bytes() + more))).positions[2] ==
          Point3{0, 1, 0});
  }
  const std::string json = with_uri("my%20buffer.bin");
  CHECK(read_gltf({folder / "a.gltf", json, ""}).positions[2] == Point3{0, 1, 0});
  CHECK(test::input_error_in(folder,
                             [&] {
                               read_gltf({folder / "a.gltf", with_uri("my%20bufer.bin"), ""});
                             }) ==
        "buffers[0].uri is 'my bufer.bin': there is no such file (did you mean "
        "'my buffer.bin'?)");
  // Two buffers may have the same file but different lengths.
  const std::string shared = test::with(
      test::with(json, "{\"buffer\": 0, \"byteOffset\": 36", "{\"buffer\": 1, \"byteOffset\": 36"),
      "\"buffers\": [", "\"buffers\": [{\"byteLength\": 106, \"uri\": \"my%20buffer.bin\"}, ");
  CHECK(read_gltf({folder / "a.gltf", shared, ""}).normals[1] == Vec3{0, 0, 1});
  CHECK(refusal(with_uri("/dev/zero")) ==
        "buffers[0].uri is '/dev/zero': it is not a regular file");
  CHECK(refusal(with_uri("data:text/plain,hello")) ==
        "buffers[0].uri is data of another kind than base64");
  CHECK(refusal(with_uri("data:;base64,AA?A")) == "buffers[0].uri holds what is no base64");
  CHECK(refusal(with_uri("data:;base64,AAAA")) == "buffers[0] has 3 bytes instead of 104");
  CHECK(refusal(test::kGltfTriangle) ==
        "buffers[0] has no 'uri' and is no binary chunk of a GLB file");
  const std::string second =
      test::with(test::with(test::kGltfTriangle, "\"buffer\": 0", "\"buffer\": 1"),
                 "{\"byteLength\": 104}", "{\"byteLength\": 104}, {\"byteLength\": 104}");
  CHECK(refusal(test::glb(second, test::triangle_bytes())) ==
        "buffers[1] has no 'uri' and is no binary chunk of a GLB file");
}

}  // namespace
}  // namespace pharos
