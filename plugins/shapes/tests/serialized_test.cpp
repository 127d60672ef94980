#include <limits>
#include <optional>
#include <zlib.h>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/tests/fixtures.h>

#include "../mesh_file.h"
#include "../serialized_file.h"
#include "gltf_test_kit.h"

namespace pharos {
namespace {

template <class T>
std::string bytes(std::initializer_list<T> numbers) {
  return test::bytes_of(std::vector<T>(numbers));
}

/// Returns a zlib stream of `plain`.
std::string packed(const std::string& plain) {
  uLongf size = compressBound(plain.size());
  std::string result(size, '\0');
  REQUIRE(compress(reinterpret_cast<Bytef*>(result.data()), &size,
                   reinterpret_cast<const Bytef*>(plain.data()), plain.size()) == Z_OK);
  result.resize(size);
  return result;
}

/// The content of a mesh before compression.
struct Content {
  std::uint32_t flags = 0x1000;
  std::optional<std::string> name = "plate";  ///< none: version 3
  std::uint64_t vertices = 3, triangles = 1;
  std::string data = bytes<float>({0, 0, 0, 2, 0, 0, 0, 3, 0}) + bytes<std::uint32_t>({0, 1, 2});

  std::string plain() const {
    return bytes<std::uint32_t>({flags}) + (name ? *name + '\0' : "") +
           bytes<std::uint64_t>({vertices, triangles}) + data;
  }
  std::string mesh() const {
    return bytes<std::uint16_t>({0x041c, static_cast<std::uint16_t>(name ? 4 : 3)}) +
           packed(plain());
  }
};

/// Returns a file of `meshes`, with 64-bit places unless `narrow`.
std::string file_of(const std::vector<std::string>& meshes, bool narrow = false) {
  std::string file, list;
  for (const std::string& mesh : meshes) {
    list += narrow ? test::little_endian(file.size()) : bytes<std::uint64_t>({file.size()});
    file += mesh;
  }
  return file + list + test::little_endian(meshes.size());
}

std::string file_of(const Content& content) {
  return file_of({content.mesh()}, !content.name);
}

TriangleMesh read(const std::string& file, std::optional<int> index = {},
                  const std::string& part = "") {
  return read_serialized({"a.serialized", file, part, index});
}

std::string refusal(const std::string& file, std::optional<int> index = {},
                    const std::string& part = "") {
  return test::input_error([&] { read(file, index, part); });
}

/// A triangle that identifies its mesh.
Content numbered(float x, const std::string& name) {
  Content content{.name = name};
  content.data = bytes<float>({x, 0, 0, x + 1, 0, 0, x, 1, 0}) + bytes<std::uint32_t>({0, 1, 2});
  return content;
}

const std::vector<Point3> kPositions{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};

}  // namespace

TEST_CASE("serialized: versions 3 and 4, single and double precision") {
  Content version_3, wide{.flags = 0x2000}, silent{.flags = 0};
  version_3.name.reset();
  wide.data = bytes<double>({0, 0, 0, 2, 0, 0, 0, 3, 0}) + bytes<std::uint32_t>({0, 1, 2});
  for (const Content& content : {Content{}, version_3, wide, silent}) {
    const TriangleMesh mesh = read(file_of(content));
    CHECK(mesh.positions == kPositions);
    CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
  }
}

TEST_CASE("serialized: normals, texture coordinates from the top, colors and face normals") {
  Content content{.flags = 0x1000 | 1 | 2 | 8};
  content.data = bytes<float>({0, 0, 0, 2, 0, 0, 0, 3, 0}) +  //
                 bytes<float>({0, 0, 1, 0, 1, 0, 1, 0, 0}) +  //
                 bytes<float>({0, 0.25f, 1, 0, 0.5f, 1}) +    //
                 bytes<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}) + bytes<std::uint32_t>({2, 1, 0});
  const TriangleMesh mesh = read(file_of(content));
  CHECK(mesh.positions == kPositions);
  CHECK(mesh.normals == std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
  CHECK(mesh.uvs == std::vector<Vec2>{{0, 0.75f}, {1, 1}, {0.5f, 0}});
  CHECK(mesh.triangles[0] == std::array<std::uint32_t, 3>{2, 1, 0});
  content.flags |= 0x10;
  const TriangleMesh faceted = read(file_of(content));
  CHECK(faceted.normals.empty());
  CHECK(faceted.positions == std::vector<Point3>(kPositions.rbegin(), kPositions.rend()));
  CHECK(faceted.uvs == std::vector<Vec2>(mesh.uvs.rbegin(), mesh.uvs.rend()));
}

TEST_CASE("serialized: one mesh by its number or its name, or all") {
  for (const bool narrow : {false, true}) {
    Content first = numbered(0, "lid"), second = numbered(10, "pot"), third = numbered(20, "lid");
    if (narrow) first.name.reset(), second.name.reset(), third.name.reset();
    const std::string file = file_of({first.mesh(), second.mesh(), third.mesh()}, narrow);
    CHECK(read(file, 0).positions[0].x == 0);
    CHECK(read(file, 1).positions[0].x == 10);
    CHECK(read(file, 2).positions[0].x == 20);
    const TriangleMesh all = read(file);
    CHECK(all.positions.size() == 9);
    CHECK(all.triangles.back() == std::array<std::uint32_t, 3>{6, 7, 8});
    CHECK(refusal(file, 3) == "there is no mesh 3: it has 3, counted from 0");
    if (narrow) continue;
    CHECK(read(file, {}, "pot").positions[0].x == 10);
    CHECK(read(file, {}, "lid").positions.size() == 6);
    CHECK(refusal(file, {}, "pott") ==
          "it has no part 'pott' (did you mean 'pot'?); its parts are 'lid', 'pot'");
  }
}

TEST_CASE("serialized: what only some of the joined meshes have is zero in the others") {
  Content bent{.flags = 0x1000 | 1};
  bent.data = bytes<float>({0, 0, 0, 2, 0, 0, 0, 3, 0}) +
              bytes<float>({0, 0, 1, 0, 1, 0, 1, 0, 0}) + bytes<std::uint32_t>({0, 1, 2});
  for (const bool first : {false, true}) {
    const TriangleMesh mesh = first ? read(file_of({bent.mesh(), Content{}.mesh()}))
                                    : read(file_of({Content{}.mesh(), bent.mesh()}));
    REQUIRE(mesh.normals.size() == 6);
    CHECK(mesh.normals[first ? 1 : 4] == Vec3{0, 1, 0});
    CHECK(mesh.normals[first ? 4 : 1] == Vec3{});
    CHECK(mesh.uvs.empty());
  }
}

TEST_CASE("serialized: large meshes, block by block") {
  constexpr std::uint32_t kTriangles = 5000;
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 3 * kTriangles; ++i) {
    const auto x = static_cast<float>(i);
    positions.push_back({x, x * x, i % 3 == 1 ? 1.0f : 0.0f});
    indices.push_back(i);
  }
  Content content{.vertices = 3 * kTriangles, .triangles = kTriangles};
  content.data = test::bytes_of(positions) + test::bytes_of(indices);
  const TriangleMesh mesh = read(file_of(content));
  CHECK(mesh.positions == positions);
  CHECK(mesh.triangles.size() == kTriangles);
  CHECK(mesh.triangles.back()[2] == 3 * kTriangles - 1);
}

TEST_CASE("serialized: what is no such file is refused") {
  const std::string no_file = "it does not begin like a 'serialized' file of Mitsuba";
  CHECK(refusal("") == no_file);
  CHECK(refusal("\x1c\x04\x04") == no_file);
  CHECK(refusal("ply\nformat ascii 1.0\n") == no_file);
  CHECK(refusal(bytes<std::uint16_t>({0x041c, 2}) + "..") ==
        "it is of version 2; known are 3 and 4");
  CHECK(refusal(bytes<std::uint16_t>({0x041c, 1024}) + "..") ==
        "it is of version 1024; known are 3 and 4");
}

TEST_CASE("serialized: lists of meshes that lie") {
  const std::string mesh = Content{}.mesh();
  const auto list = [&](std::initializer_list<std::uint64_t> places, std::size_t count) {
    return refusal(mesh + bytes<std::uint64_t>(places) + test::little_endian(count));
  };
  const auto end = std::to_string(mesh.size());
  CHECK(list({0}, 0) == "its list of meshes is cut off or names 0 of them");
  CHECK(list({0}, 100) == "its list of meshes is cut off or names 100 of them");
  CHECK(list({0}, 4'294'967'295) == "its list of meshes is cut off or names 4294967295 of them");
  CHECK(list({mesh.size()}, 1) == "mesh 0 lies from byte " + end + " to " + end + " of " + end);
  CHECK(list({std::numeric_limits<std::uint64_t>::max()}, 1) ==
        "mesh 0 lies from byte 18446744073709551615 to " + end + " of " + end);
  CHECK(list({0, 0}, 2) == "mesh 0 lies from byte 0 to 0 of " + end);
  CHECK(list({8, 4}, 2) == "mesh 0 lies from byte 8 to 4 of " + end);
  CHECK(list({0, mesh.size() + 8}, 2) ==
        "mesh 0 lies from byte 0 to " + std::to_string(mesh.size() + 8) + " of " + end);
  CHECK(list({1}, 1) == "mesh 0: it does not begin like a 'serialized' file of Mitsuba");
  CHECK(list({0, mesh.size() - 3}, 2) ==
        "mesh 1: it does not begin like a 'serialized' file of Mitsuba");
  CHECK(refusal(mesh).starts_with("its list of meshes is cut off"));
}

TEST_CASE("serialized: streams that are damaged or cut off anywhere") {
  const std::string mesh = Content{}.mesh();
  std::string damaged = mesh;
  damaged[4] = 'y';
  CHECK(refusal(file_of({damaged})) == "mesh 0: its compressed data are damaged");
  damaged = mesh;
  damaged[mesh.size() / 2] = static_cast<char>(damaged[mesh.size() / 2] ^ 0x5a);
  CHECK(refusal(file_of({mesh, damaged})).starts_with("mesh 1: "));
  damaged = mesh;
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  CHECK(refusal(file_of({damaged})) == "mesh 0: its compressed data are damaged");  // the checksum
  for (std::size_t size = 0; size + 6 < mesh.size(); ++size) {
    CAPTURE(size);
    CHECK_FALSE(refusal(file_of({mesh.substr(0, size)})).empty());
  }
  const std::string plain = Content{}.plain();
  for (std::size_t size = 0; size < plain.size(); ++size) {
    CAPTURE(size);
    CHECK(refusal(file_of({mesh.substr(0, 4) + packed(plain.substr(0, size))}))
              .starts_with("mesh 0: it ends before its "));
  }
}

TEST_CASE("serialized: contents that lie or make no sense") {
  const auto changed = [](auto&& change) {
    Content content;
    change(content);
    return refusal(file_of(content));
  };
  CHECK(changed([](Content& c) { c.vertices = 4; }) == "mesh 0: it ends before its 1 triangles");
  CHECK(changed([](Content& c) { c.vertices = 400'000'000; }) ==
        "mesh 0: it ends before its 400000000 positions");
  CHECK(changed([](Content& c) { c.vertices = std::numeric_limits<std::uint64_t>::max(); }) ==
        "mesh 0: it would have 18446744073709551615 vertices; at most 600000000 are possible");
  CHECK(changed([](Content& c) { c.triangles = 100'000'000; }) ==
        "mesh 0: it ends before its 100000000 triangles");
  CHECK(changed([](Content& c) { c.triangles = 1'000'000'000; }) ==
        "mesh 0: it would have 1000000000 triangles; at most 200000000 are possible");
  CHECK(changed([](Content& c) { c.vertices = 2; }).starts_with("mesh 0: triangle 0 names vertex"));
  CHECK(changed([](Content& c) { c.flags |= 1; }) == "mesh 0: it ends before its 3 normals");
  CHECK(changed([](Content& c) { c.flags |= 2; }) ==
        "mesh 0: it ends before its 3 texture coordinates");
  CHECK(changed([](Content& c) { c.flags |= 8; }) == "mesh 0: it ends before its 3 colors");
  CHECK(changed([](Content& c) { c.flags = 0x2000; }) == "mesh 0: it ends before its 3 positions");
  CHECK(changed([](Content& c) { c.name = std::string(5000, 'a'); }) ==
        "mesh 0: its name does not end");
  CHECK(changed([](Content& c) {
          c.data =
              bytes<float>({0, 0, 0, 2, kInfinity, 0, 0, 3, 0}) + bytes<std::uint32_t>({0, 1, 2});
        }) == "mesh 0: position 1 is not finite");
  CHECK(changed([](Content& c) {
          c.flags = 0x2000;
          c.data = bytes<double>({0, 0, 0, 2, 0, 0, 0, 3, 1e300}) + bytes<std::uint32_t>({0, 1, 2});
        }) == "mesh 0: position 2 is not finite");
  CHECK(changed([](Content& c) {
          c.data = bytes<float>({0, 0, 0, 2, 0, 0, 0, 3, 0}) + bytes<std::uint32_t>({0, 1, 3});
        }) == "mesh 0: triangle 0 names vertex 3, which is missing");
  Content unnamed;
  unnamed.name.reset();
  CHECK(refusal(file_of(unnamed), {}, "plate") ==
        "files of version 3 have no names; 'shape_index' chooses a mesh");
}

TEST_CASE("serialized: whatever a stream holds, it is a mesh or an InputError") {
  RandomStream random(9);
  const std::string plain = Content{}.plain();
  int meshes = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string changed = plain;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(random.next_1d() * static_cast<float>(plain.size()));
      changed[at] = static_cast<char>(static_cast<unsigned char>(random.next_1d() * 256));
    }
    try {
      read(file_of({bytes<std::uint16_t>({0x041c, 4}) + packed(changed)}));
      ++meshes;
    } catch (const InputError&) {
    }
  }
  CHECK(meshes > 0);
  CHECK(meshes < 3000);
}

TEST_CASE("serialized: a file that asks for face normals is not smoothed, another one is") {
  const test::TemporaryFolder folder;
  Content fold{.vertices = 4, .triangles = 2};
  fold.data =
      bytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + bytes<std::uint32_t>({0, 1, 2, 0, 3, 1});
  const auto vertex_count = [&](std::uint32_t flags) {
    fold.flags = 0x1000 | flags;
    const auto path = folder.write("a.serialized", file_of(fold));
    return read_mesh_file({.file = path, .normals = MeshNormals::file_or_smooth}).positions.size();
  };
  CHECK(vertex_count(0) == 4);
  CHECK(vertex_count(0x10) == 6);
}

TEST_CASE("serialized: through the file, where empty meshes are an error") {
  const test::TemporaryFolder folder;
  const auto path = folder.write("a.serialized", file_of(numbered(5, "lid")));
  CHECK(read_mesh_file({.file = path, .shape_index = 0}).positions[0].x == 5);
  CHECK(read_mesh_file({.file = path, .part = "lid"}).positions[0].x == 5);
  folder.write("a.serialized", file_of(Content{.vertices = 0, .triangles = 0, .data = ""}));
  CHECK(test::input_error([&] {
          read_mesh_file({.file = path});
        }).ends_with("a.serialized': it holds no triangles"));
}

}  // namespace pharos
