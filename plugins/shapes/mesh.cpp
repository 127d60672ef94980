// mesh: all triangles of a file, in any format that Assimp reads (OBJ, PLY, glTF, STL, ...). Meshes
// within the file are joined and polygons cut into triangles. Shading normals are those of the
// file, if it has any, unless `face_normals` is set; materials in the file are not used. Triangles
// without area are left out.
//
//     type: mesh
//     file: bunny.ply
//     to_world: { scale: 10 }

#include "mesh.h"

#include "mesh_file.h"

namespace pharos {

void Mesh::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file, "The file with the triangles").required();
  s.field("to_world", &Settings::to_world, "From the file's space to world space");
  s.field("flip_normals", &Settings::flip_normals, "Exchange the outer and the inner side");
  s.field("face_normals", &Settings::face_normals, "Ignore the file's shading normals");
}

Mesh::Mesh(const Settings& settings)
    : TriangleShape(transformed(read_mesh_file(settings.file, settings.face_normals),
                                settings.to_world, settings.flip_normals),
                    settings.file.string()) {}

}  // namespace pharos
