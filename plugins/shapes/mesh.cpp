// mesh: the triangles of a file, in any format that Assimp reads (OBJ, PLY, glTF and GLB, STL,
// ...). Meshes within the file are joined, with the transforms of its nodes applied, and polygons
// cut into triangles. `part` takes only the mesh or node of that name, a node with all that lies
// below it, so that parts of one file can have materials of their own. Shading normals are those of
// the file, if it has any, unless `face_normals` is set; materials in the file are not used.
// Triangles without area are left out.
//
// Texture coordinates have their origin at the lower left of the picture, as `bitmap` has. Files of
// formats where v runs from the top (glTF) are converted, so that pictures look as their author saw
// them.
//
//     type: mesh
//     file: kitchen.glb
//     part: kettle
//     to_world: { scale: 10 }

#include "mesh.h"

#include "mesh_file.h"

namespace pharos {

void Mesh::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file, "The file with the triangles").required();
  s.field("part", &Settings::part, "Only the mesh or node of this name; empty: everything");
  s.field("to_world", &Settings::to_world, "From the file's space to world space");
  s.field("flip_normals", &Settings::flip_normals, "Exchange the outer and the inner side");
  s.field("face_normals", &Settings::face_normals, "Ignore the file's shading normals");
  s.example("{ file: example.ply, face_normals: true, to_world: { scale: [1, -2, 3] } }");
}

Mesh::Mesh(const Settings& settings)
    : TriangleShape(transformed(read_mesh_file(settings.file, settings.part, settings.face_normals),
                                settings.to_world, settings.flip_normals),
                    settings.file.string()) {}

}  // namespace pharos
