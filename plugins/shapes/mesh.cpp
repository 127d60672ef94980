// mesh: the triangles of a file. Its extension says which format it has:
//
//   .gltf .glb    glTF 2.0; parts are its nodes and meshes
//   .obj          Wavefront OBJ; parts are its objects (o) and groups (g)
//   .ply          PLY, text or binary; it has no parts
//   .serialized   Mitsuba's, version 3 or 4; parts are its meshes, in version 4, and `shape_index`
//                 chooses one by its number, from 0
//   .stl          STL, text or binary; it has no parts
//
// Meshes within the file are joined, with the transforms of its nodes applied, and polygons, which
// are taken to be convex, cut into triangles that fan out from their first corner. `part` takes
// only the mesh or node of that name, a node with all that lies below it, so that parts of one file
// can have materials of their own. Shading normals are those of the file, if it has any, unless
// `face_normals` is set (those of STL files, one a triangle, are not used); meshes without normals
// or texture coordinates, where others of the part have them, get zeros. Materials, lines, points,
// skins and animations in the file are not used. Triangles without area are left out.
//
// Texture coordinates have their origin at the lower left of the picture, as `bitmap` has. Those of
// glTF and `serialized` files, where v runs from the top, are converted, so that pictures look as
// their author saw them.
//
// A damaged file is an error that says where: no count in it is believed before the bytes are
// there. glTF files may use every type of numbers, KHR_mesh_quantization included; sparse accessors
// and EXT_mesh_gpu_instancing are refused by name, as are required extensions other than those of
// materials, textures and lights (KHR_draco_mesh_compression, EXT_meshopt_compression, …).
//
//     type: mesh
//     file: kitchen.glb
//     part: kettle
//     to_world: { scale: 10 }

#include "mesh.h"

#include "mesh_file.h"

namespace pharos {

void Mesh::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file,
          "The file with the triangles: .glb, .gltf, .obj, .ply, .serialized or .stl")
      .required();
  s.field("part", &Settings::part, "Only the mesh or node of this name; empty: everything");
  s.field("shape_index", &Settings::shape_index,
          "Only the mesh of this number, from 0; .serialized files alone")
      .at_least(0);
  s.field("to_world", &Settings::to_world, "From the file's space to world space");
  s.field("flip_normals", &Settings::flip_normals, "Exchange the outer and the inner side");
  s.field("face_normals", &Settings::face_normals, "Ignore the file's shading normals");
  s.example("{ file: example.ply, face_normals: true, to_world: { scale: [1, -2, 3] } }");
}

Mesh::Mesh(const Settings& settings)
    : TriangleShape(transformed(read_mesh_file(settings.file, settings.part, settings.face_normals,
                                               settings.shape_index),
                                settings.to_world, settings.flip_normals),
                    settings.file.string()) {}

}  // namespace pharos
