// Every kind of damage to a glTF file causes one message, which names the place.

#include <limits>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

#include "../gltf_file.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

std::string refusal(const std::string& bytes) {
  return test::input_error([&] { read_gltf({"file.gltf", bytes, ""}); });
}

/// Returns the message for the triangle with a change in its JSON, in a GLB file.
std::string refusal(const std::string& what, const std::string& by) {
  return refusal(test::glb(test::with(test::kGltfTriangle, what, by), test::triangle_bytes()));
}

TEST_CASE("glTF: text that is no JSON") {
  // The rest of the message is the JSON library's, and differs between its versions.
  CHECK(refusal("").starts_with("file.gltf:1:1: error: syntax error"));
  CHECK(refusal("{\n  \"asset\": nul\n}").starts_with("file.gltf:2:15: error: syntax error"));
  CHECK(refusal("[1e999]").starts_with("its JSON: number overflow parsing '1e999'"));
  CHECK(refusal("\"\xff\"").starts_with("file.gltf:1:2: error: syntax error"));
  CHECK(refusal("[]") == "its JSON is no object");
  CHECK(refusal("{}") == "its JSON has no 'asset'");
}

TEST_CASE("glTF: damaged chunks") {
  const std::string whole = test::glb(test::kGltfTriangle, test::triangle_bytes());
  CHECK(refusal(whole) == "no error");
  CHECK(refusal("glTF") == "it ends within its header");
  CHECK(refusal("glTF" + test::little_endian(1) + test::little_endian(12)) ==
        "it is GLB of version 1; known is 2");
  CHECK(refusal("glTF" + test::little_endian(2) + test::little_endian(12)) == "it has no JSON");
  CHECK(refusal(whole.substr(0, 1000)) ==
        "it is cut off: 1000 of " + std::to_string(whole.size()) + " bytes");
  CHECK(refusal("glTF" + test::little_endian(2) + test::little_endian(25) +
                test::little_endian(4'000'000'000) + "JSON{}   ") ==
        "a chunk of 4000000000 bytes is cut off after 5");
  CHECK(refusal(test::glb("{\"asset\": }", "")).starts_with("byte 10 of its JSON: syntax error"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CHECK(refusal(whole.substr(0, size)) != "no error");
  }
}

TEST_CASE("glTF: what is missing, of another kind, or named and not there") {
  CHECK(refusal("\"2.0\"", "\"1.0\"") == "it is glTF 1.0; known is 2.0");
  CHECK(refusal("\"2.0\"", "2") == "asset.version is no text");
  CHECK(refusal("\"scene\": 0", "\"scene\": 1") == "scene names item 1 of scenes, which has 1");
  CHECK(refusal("\"scene\": 0", "\"scene\": -1") == "scene is no whole number from 0 on");
  CHECK(refusal("\"scene\": 0", "\"scene\": 0.5") == "scene is no whole number from 0 on");
  CHECK(refusal("\"scene\": 0", "\"scene\": \"0\"") == "scene is no number");
  CHECK(refusal("[0]", "[7]") == "scenes[0].nodes[0] names item 7 of nodes, which has 1");
  CHECK(refusal("[0]", "0") == "scenes[0].nodes is no list");
  CHECK(refusal("{\"nodes\": [0]}", "{}") == "scenes[0] has no 'nodes'");
  CHECK(refusal("\"scene\": 0,\n  \"scenes\": [{\"nodes\": [0]}]", "\"scenes\": []") ==
        "scenes has no item 0; it has 0");
  CHECK(refusal("\"leaf\"", "5") == "nodes[0].name is no text");
  CHECK(refusal("\"mesh\": 0", "\"mesh\": 9") ==
        "nodes[0].mesh names item 9 of meshes, which has 1");
  CHECK(refusal("\"POSITION\": 0, ", "") == "meshes[0].primitives[0].attributes has no 'POSITION'");
  CHECK(refusal("\"mode\": 4", "\"mode\": 7") ==
        "meshes[0].primitives[0] has mode 7; the last one is 6");
  CHECK(refusal("\"indices\": 3", "\"indices\": 4") ==
        "meshes[0].primitives[0].indices names item 4 of accessors, which has 4");
}

TEST_CASE("glTF: accessors that do not fit their buffer or their use") {
  const std::string first = R"("componentType": 5126, "count": 3})";
  CHECK(refusal(first, R"("componentType": 5126, "count": 4})") ==
        "accessors[0] has 4 items, which exceed bufferViews[0]");
  for (const char* count : {"4294967296", "1537228672809129302", "18446744073709551615"}) {
    CHECK(refusal(first, R"("componentType": 5126, "count": )" + std::string(count) + "}") ==
          "accessors[0] has " + std::string(count) + " items, which exceed bufferViews[0]");
  }
  CHECK(refusal(first, R"("componentType": 5124, "count": 3})") ==
        "accessors[0].componentType is 5124, which is no type of components");
  CHECK(refusal(first, R"("componentType": 5126, "count": 3, "sparse": {}})") ==
        "accessors[0] is sparse, which is not read");
  CHECK(refusal(first, R"("componentType": 5126, "count": 3, "normalized": 1})") ==
        "accessors[0].normalized is neither true nor false");
  CHECK(refusal("\"bufferView\": 0, ", "") == "accessors[0] has no 'bufferView'");
  CHECK(refusal("VEC3", "MAT4") ==
        "meshes[0].primitives[0].attributes.POSITION needs VEC3, and accessors[0] is MAT4");
  CHECK(refusal("\"byteOffset\": 0}", "\"byteOffset\": 37}") ==
        "accessors[1] begins at byte 37 of 36");
  CHECK(refusal("\"byteStride\": 12", "\"byteStride\": 0") ==
        "bufferViews[0] has a byteStride of 0 for VEC3");
  CHECK(refusal("\"byteStride\": 12", "\"byteStride\": 18446744073709551615") ==
        "accessors[0] has 3 items, which exceed bufferViews[0]");
  CHECK(refusal("\"byteLength\": 36", "\"byteLength\": 105") ==
        "bufferViews[0] has 105 bytes, and its buffer 104 left");
  CHECK(refusal("\"byteOffset\": 96", "\"byteOffset\": 99") ==
        "bufferViews[3] has 6 bytes, and its buffer 5 left");
  CHECK(refusal("\"byteOffset\": 96", "\"byteOffset\": 18446744073709551615") ==
        "bufferViews[3] begins at byte 18446744073709551615 of 104");
  CHECK(refusal("\"byteLength\": 104", "\"byteLength\": 105") ==
        "buffers[0] has 104 bytes instead of 105");
}

TEST_CASE("glTF: primitives whose parts do not fit together") {
  const auto with_accessor = [](std::string_view type, const std::string& by) {
    return refusal(
        "\"type\": \"" + std::string(type) + "\", \"componentType\": 5126, \"count\": 3}",
        "\"type\": \"" + std::string(type) + "\", " + by + "}");
  };
  CHECK(refusal("\"count\": 3, \"byteOffset\"", "\"count\": 2, \"byteOffset\"") ==
        "meshes[0].primitives[0] has 2 normals for 3 vertices");
  CHECK(with_accessor("VEC2", R"("componentType": 5126, "count": 2)") ==
        "meshes[0].primitives[0] has 2 texture coordinates for 3 vertices");
  CHECK(refusal("5123", "5122") ==
        "meshes[0].primitives[0] has indices that are no unsigned integers");
  CHECK(refusal("5123, \"count\": 3", "5123, \"count\": 2") ==
        "meshes[0].primitives[0] has 2 corners of triangles, no multiple of three");
  CHECK(refusal(test::glb(test::kGltfTriangle, test::triangle_bytes(1, 3))) ==
        "meshes[0].primitives[0] names vertex 3; it has 3");
  for (const float x : {std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
    CHECK(refusal(test::glb(test::kGltfTriangle, test::triangle_bytes(x))) ==
          "meshes[0].primitives[0] has vertex 1, which is not finite");
  }
  CHECK(refusal("\"mesh\": 0", "\"mesh\": 0, \"scale\": [1e300, 1, 1]") ==
        "meshes[0].primitives[0] has vertex 1, which is not finite");
}

TEST_CASE("glTF: nodes that are no tree, or placed by what is no map") {
  const auto node = [](const std::string& more) {
    return refusal("\"mesh\": 0", "\"mesh\": 0, " + more);
  };
  CHECK(node("\"children\": [0]") == "nodes[0] is reached twice; nodes must form a tree");
  CHECK(refusal("[0]", "[0, 0]") == "nodes[0] is reached twice; nodes must form a tree");
  CHECK(node("\"children\": [1]") == "nodes[0].children[0] names item 1 of nodes, which has 1");
  CHECK(node("\"scale\": [1, 1]") == "nodes[0].scale has 2 numbers instead of 3");
  CHECK(node("\"translation\": [1, 1, \"1\"]") == "nodes[0].translation[2] is no number");
  CHECK(node("\"matrix\": [1, 0, 0, 0]") == "nodes[0].matrix has 4 numbers instead of 16");
  CHECK(node("\"rotation\": [0, 0, 0, 0]") == "nodes[0] has a rotation about nothing");
  CHECK(node("\"extensions\": {\"EXT_mesh_gpu_instancing\": {}}") ==
        "nodes[0] is placed by EXT_mesh_gpu_instancing, which is not read");

  std::string chain = "{\"mesh\": 0";
  for (int i = 1; i < 501; ++i)
    chain += ", \"children\": [" + std::to_string(i) + "]}, {\"mesh\": 0";
  CHECK(refusal("{\"name\": \"leaf\", \"mesh\": 0", chain) ==
        "nodes[500] lies deeper than 500 levels");
}

TEST_CASE("glTF: extensions that a file needs are known to leave the triangles alone, or refused") {
  const auto needs = [](const std::string& name) {
    return refusal("\"scene\": 0", "\"extensionsRequired\": [\"" + name + "\"]");
  };
  for (const std::string name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                 "KHR_node_visibility", "MSFT_lod", "ACME_teapots", ""}) {
    CHECK(needs(name) == "it needs '" + name + "', which is not read");
  }
  for (const char* name : {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp",
                           "KHR_lights_punctual", "KHR_mesh_quantization"}) {
    CHECK(needs(name) == "no error");
  }
}

TEST_CASE("glTF: files that would not fit into memory") {
  // A mesh of 65534 triangles, placed by 4000 nodes.
  std::string nodes = "{\"mesh\": 0}", roots = "[0";
  for (int i = 1; i < 4000; ++i) {
    nodes += ", {\"mesh\": 0}";
    roots += ", " + std::to_string(i);
  }
  std::string json = test::with(test::kGltfTriangle, "[0]", roots + "]");
  json = test::with(json, "{\"name\": \"leaf\", \"mesh\": 0}", nodes);
  json = test::with(json, "\"mode\": 4", "\"mode\": 6");
  json = test::with(json, "5123, \"count\": 3", "5121, \"count\": 65536");
  json = test::with(json, "\"byteLength\": 6}", "\"byteLength\": 65536}");
  json = test::with(json, "\"byteLength\": 104", "\"byteLength\": 65632");
  CHECK(refusal(test::glb(json, test::triangle_bytes() + std::string(65632 - 104, '\0'))) ==
        "it would have 262136000 triangles; at most 200000000 are possible");
}

}  // namespace
}  // namespace pharos
