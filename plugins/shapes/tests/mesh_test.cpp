#include "../mesh.h"

#include <sys/stat.h>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

namespace pharos {
namespace {

/// Two objects: a unit square in the plane z = 0 with tilted normals, and a triangle above it.
const char* const kTwoObjects =
    "o square\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vn 0.6 0 0.8\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1/1 2/2/1 3/3/1 4/4/1\n"
    "o triangle\n"
    "v 0 0 1\nv 2 0 1\nv 0 2 1\n"
    "f 5/1/1 6/2/1 7/3/1\n";

/// A temporary mesh file.
struct MeshFile {
  test::TemporaryFolder folder;
  std::filesystem::path path;

  MeshFile(const std::string& name, const std::string& text) : path(folder.write(name, text)) {}

  Mesh load(Mesh::Settings settings = {}) const {
    settings.file = path;
    return Mesh(settings);
  }
};

TEST_CASE("all objects of a file are joined and polygons cut into triangles") {
  const MeshFile file("two.obj", kTwoObjects);
  const Mesh mesh = file.load();
  CHECK(mesh.primitive_count() == 3);
  CHECK(mesh.area() == doctest::Approx(3));
  CHECK(mesh.bounds().high.x == 2);
  CHECK(mesh.bounds().high.z == 1);
  CHECK(mesh.mesh()->uvs.size() == mesh.mesh()->positions.size());
}

TEST_CASE("shading normals are the file's unless told otherwise") {
  const MeshFile file("normals.obj", kTwoObjects);
  const Mesh smooth = file.load();
  const SurfacePoint p = smooth.mesh()->surface_point(0, 0.3f, 0.3f);
  CHECK(p.normal.z == doctest::Approx(1));
  CHECK(p.shading.n.x == doctest::Approx(0.6));
  CHECK(p.shading.n.z == doctest::Approx(0.8));
  const Mesh flat = file.load({.normals = MeshNormals::flat});
  CHECK(flat.mesh()->normals.empty());
  CHECK(flat.mesh()->surface_point(0, 0.3f, 0.3f).shading.n.z == doctest::Approx(1));
}

TEST_CASE("mirroring keeps the outer side, flip_normals exchanges it") {
  const MeshFile file("mirror.obj", kTwoObjects);
  for (const float mirror : {1.0f, -1.0f}) {
    for (const bool flip : {false, true}) {
      const Mesh mesh =
          file.load({.to_world = Transform::scale({mirror, 1, 1}), .flip_normals = flip});
      const SurfacePoint p = mesh.mesh()->surface_point(0, 0.3f, 0.3f);
      const float side = flip ? -1.0f : 1.0f;
      CHECK(p.normal.z == doctest::Approx(side));
      CHECK(p.shading.n.x == doctest::Approx(side * mirror * 0.6));
      CHECK(p.shading.n.z == doctest::Approx(side * 0.8));
    }
  }
}

TEST_CASE("a file without normals has those of its faces, and barycentric coordinates") {
  const MeshFile file("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Mesh mesh = file.load();
  CHECK(mesh.mesh()->normals.empty());
  const SurfacePoint p = mesh.mesh()->surface_point(0, 0.25f, 0.5f);
  CHECK(p.uv == Vec2{0.25f, 0.5f});
  CHECK(p.position.x == doctest::Approx(0.25));
  CHECK(p.position.y == doctest::Approx(0.5));
}

TEST_CASE("triangles without area are left out") {
  const MeshFile file("thin.obj",
                      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 4\nf 1 2 3\nf 1 1 2\n");
  CHECK(file.load().primitive_count() == 1);
}

TEST_CASE("a mesh of triangles without area has no area") {
  const MeshFile file("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  CHECK(file.load().area() == 0);
}

TEST_CASE("what cannot be a surface is an error that names the file") {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    return test::input_error_in(folder, [&] { Mesh({.file = folder.write(name, text)}); });
  };
  const std::string points = "v 0 0 0\nv 1 0 0\nv 2 0 0\n";
  CHECK(message("empty.obj", "") == "mesh 'empty.obj': it holds no triangles");
  CHECK(message("points.obj", points) == "mesh 'points.obj': it holds no triangles");
  CHECK(message("index.obj", points + "f 1 2 9\n") ==
        "index.obj:4:7: error: there is no vertex 9; it is preceded by 3");
  CHECK(message("empty.stl", "") == "mesh 'empty.stl': it is too short for an STL file");
  CHECK(message("empty.PLY", "") == "mesh 'empty.PLY': it ends within the header");
  CHECK(message("empty.glb", "glTF") == "mesh 'empty.glb': it ends within its header");
  CHECK(message("empty.gltf", "{}") == "mesh 'empty.gltf': its JSON has no 'asset'");
  CHECK(test::input_error([] { Mesh({.file = "/nowhere/missing.obj"}); }) ==
        "mesh '/nowhere/missing.obj': there is no such file");
}

TEST_CASE("other formats are refused with a list and the nearest") {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& part) {
    const auto file = folder.write(name, "mesh");
    return test::input_error_in(folder, [&] { Mesh({.file = file, .part = part}); });
  };
  const std::string list =
      "; known are '.glb', '.gltf', '.obj', '.pbrt', '.ply', '.serialized', '.stl'";
  CHECK(message("a.fbx", "") == "mesh 'a.fbx': the format '.fbx' is not known" + list);
  CHECK(message("a.gltff", "") ==
        "mesh 'a.gltff': the format '.gltff' is not known (did you mean '.gltf'?)" + list);
  CHECK(message("mesh", "") == "mesh 'mesh': the format '' is not known" + list);
  CHECK(test::input_error([] {
          Mesh({.file = "/dev/zero"});
        }).starts_with("mesh '/dev/zero': the format '' is not known"));  // no file is read before
  CHECK(message("a.stl", "lid") == "mesh 'a.stl': .stl files have no parts");
  CHECK(message("a.ply", "lid") == "mesh 'a.ply': .ply files have no parts");
  const auto numbered = [&](const std::string& name, const std::string& part) {
    const auto file = folder.write(name, "mesh");
    return test::input_error_in(folder,
                                [&] { Mesh({.file = file, .part = part, .shape_index = 0}); });
  };
  CHECK(numbered("a.obj", "") == "mesh 'a.obj': .obj files do not number their meshes");
  CHECK(numbered("a.serialized", "lid") ==
        "mesh 'a.serialized': 'part' and 'shape_index' exclude each other");
}

TEST_CASE("only regular files are opened, those that a file names too") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.obj");
  std::filesystem::create_symlink("/dev/zero", folder / "zero.ply");
  REQUIRE(mkfifo((folder / "pipe.stl").c_str(), 0600) == 0);
  for (const char* name : {"folder.obj", "zero.ply", "pipe.stl"}) {
    const std::string message =
        test::input_error_in(folder, [&] { Mesh({.file = folder / name}); });
    CHECK(message == "mesh '" + std::string(name) + "': it is not a regular file");
  }
  folder.write("bunny.obj", kTwoObjects);
  CHECK(test::input_error_in(folder, [&] { Mesh({.file = folder / "buny.obj"}); }) ==
        "mesh 'buny.obj': there is no such file (did you mean 'bunny.obj'?)");
}

}  // namespace
}  // namespace pharos
