// Mesh files that are damaged, state a wrong size, or contain no surface.

#include <doctest/doctest.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

TEST_CASE("OBJ") {
  check_mesh_refused("empty.obj", "");
  check_mesh_refused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  check_mesh_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "4:7");
  check_mesh_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "4:7");
  check_mesh_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "4:3");
  check_mesh_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999\n", "4:7");
  check_mesh_refused("number.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "1:7");
  check_mesh_refused("number.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n", "2:3");
  check_mesh_refused("prose.obj", "This is no mesh.\n", "1:1");
}

TEST_CASE("other formats") {
  check_mesh_refused("empty.stl", "");
  check_mesh_refused("cut.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "5:1");
  check_mesh_refused("count.stl",
                     std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(50, '\0'));
  check_mesh_refused("empty.gltf", "", "1:1");
  check_mesh_refused("cut.gltf", "{ \"asset\": { \"version\": \"2.0\" }, \"scene", "1:40");
  check_mesh_refused("nothing.gltf", "{ \"asset\": { \"version\": \"2.0\" } }");
  check_mesh_refused("mesh.xyz", "1 2 3\n");
  check_mesh_refused("mesh", "1 2 3\n");
  check_mesh_refused("image.ply", "\x89PNG\r\n\x1a\n");
}

TEST_CASE("what is no file") {
  for (const char* path : {"nothing.ply", ".", "/dev/zero"}) {
    check_refused(config_with_shape("{ type: mesh, file: " + std::string(path) + " }"),
                  {"bad.yaml:4:7: error: ", "mesh '"});
  }
}

}  // namespace
}  // namespace pharos::testing
