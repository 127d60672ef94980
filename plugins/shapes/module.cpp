#include <pharos/config/module.h>

#include "box.h"
#include "cylinder.h"
#include "disk.h"
#include "heightfield.h"
#include "lathe.h"
#include "mesh.h"
#include "quad.h"
#include "sphere.h"

PHAROS_MODULE(registry) {
  registry.add<pharos::Box>("box", "The cube [-1,1]^3, transformed");
  registry.add<pharos::Cylinder>("cylinder", "An exact open tube between two points");
  registry.add<pharos::Disk>("disk", "The exact unit disk that faces +z, transformed");
  registry.add<pharos::Heightfield>(
      "heightfield", "A landscape over [-1,1]^2 whose height is the brightness of a texture");
  registry.add<pharos::Lathe>("lathe", "A surface of revolution about the z axis");
  registry.add<pharos::Mesh>(
      "mesh", "Triangles from a file: glTF, OBJ, PLY, STL or Mitsuba's serialized format");
  registry.add<pharos::Quad>("quad", "The square [-1,1]^2 that faces +z, transformed");
  registry.add<pharos::Sphere>("sphere", "An exact sphere");
}
