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

/// A mesh file of its own.
struct MeshFile {
  test::TemporaryFolder folder;
  std::filesystem::path path;

  MeshFile(const std::string& name, const std::string& text) : path(folder.write(name, text)) {}

  Mesh load(Mesh::Settings settings = {}) const {
    settings.file = path;
    return Mesh(settings);
  }
};

/// The message must name the file and give the reason.
void check_error(const std::string& name, const std::string& text, const std::string& reason) {
  const MeshFile file(name, text);
  const std::string message = test::input_error([&] { file.load(); });
  INFO(message);
  CHECK(message.find(file.path.string()) != std::string::npos);
  CHECK(message.find(reason) != std::string::npos);
}

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
  const Mesh flat = file.load({.face_normals = true});
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

TEST_CASE("what cannot be a surface is an error that names the file") {
  const std::string missing = test::input_error([] { Mesh({.file = "/nowhere/missing.obj"}); });
  CHECK(missing == "mesh '/nowhere/missing.obj': there is no such file");
  check_error("empty.obj", "", "mesh");
  check_error("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "mesh");
  check_error("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "area");
  check_error("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "finite");
  check_error("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "mesh");
  check_error("words.obj", "this is not a mesh", "mesh");
  check_error("unknown.xyzzy", "this is not a mesh", "mesh");
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
  // A pipe would wait for someone to write into it.
  const MeshFile file("library.obj", "mtllib " + (folder / "pipe.stl").string() +
                                         "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(file.load().primitive_count() == 1);
  folder.write("bunny.obj", kTwoObjects);
  CHECK(test::input_error_in(folder, [&] { Mesh({.file = folder / "buny.obj"}); }) ==
        "mesh 'buny.obj': there is no such file (did you mean 'bunny.obj'?)");
}

TEST_CASE("a binary file that was cut off is an error") {
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::array<float, 9> vertices{0, 0, 0, 1, 0, 0, 0, 1, 0};
  ply.append(reinterpret_cast<const char*>(vertices.data()), sizeof(vertices));
  const std::array<std::int32_t, 3> face{0, 1, 2};
  const std::string whole =
      ply + '\3' + std::string(reinterpret_cast<const char*>(face.data()), sizeof(face));
  const MeshFile file("whole.ply", whole);
  CHECK(file.load().primitive_count() == 1);
  check_error("cut-faces.ply", ply, "mesh");
  check_error("cut-vertices.ply", ply.substr(0, ply.size() - 20), "mesh");
}

}  // namespace
}  // namespace pharos
