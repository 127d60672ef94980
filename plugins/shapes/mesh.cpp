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
// can have materials of their own. Meshes without texture coordinates, where others of the part
// have them, get zeros. Materials, lines, points, skins and animations in the file are not used.
// Triangles without area are left out.
//
// Shading normals are those of the file (but for STL, which has one a triangle). What becomes of
// vertices without a normal, `normals` says:
//
//   file_or_flat     the surface is shaded as flat as it is
//   file_or_smooth   a vertex gets the mean of the triangles' normals around it, weighted by their
//                    angles (Thuermer and Wuethrich 1998), as Mitsuba does it
//   flat             flat everywhere: the file's normals are not used either
//
// Triangles are smoothed across the vertices that they share in the file. A vertex that stands
// there twice keeps an edge, be it meant as one or a seam of the texture; in OBJ files, vertices
// are pairs of a position and a texture coordinate. Triangles of STL files share where they agree
// exactly.
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
  s.field("normals", &Settings::normals, "Shading normals: the file's, and those it lacks");
  s.example("{ file: example.ply, normals: flat, to_world: { scale: [1, -2, 3] } }");
  s.example("{ file: example.ply, normals: file_or_smooth }");
}

Mesh::Mesh(const Settings& settings)
    : TriangleShape(read_mesh_file(settings), settings.file.string()) {}

}  // namespace pharos
