#include <pharos/config/module.h>

#include "box.h"
#include "mesh.h"
#include "quad.h"
#include "sphere.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::Box>("box", "The cube [-1,1]^3, transformed");
  registry.add<pharos::Mesh>("mesh", "Triangles from a file: OBJ, PLY, glTF, ...");
  registry.add<pharos::Quad>("quad", "The square [-1,1]^2 that faces +z, transformed");
  registry.add<pharos::Sphere>("sphere", "An exact sphere");
}
