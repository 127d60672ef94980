// mesh: the triangles of a file. The file name extension determines the format:
//
//   .gltf .glb    glTF 2.0; parts are its nodes and meshes
//   .obj          Wavefront OBJ; parts are its objects (o) and groups (g)
//   .pbrt         a mesh within a scene file of pbrt-v4; parts are the places 'line:column' of its
//                 `Shape` directives; the importer `pbrt` refers to them
//   .ply          PLY, text or binary; it has no parts
//   .serialized   Mitsuba's format, version 3 or 4; in version 4 its meshes are its parts;
//                 `shape_index` selects a mesh by its number, from 0
//   .stl          STL, text or binary; it has no parts
//
// Meshes within the file are joined, with the transforms of its nodes applied. Polygons are assumed
// to be convex and are cut into triangles that fan out from their first corner. `part` selects only
// the mesh or node of that name, a node with everything below it, so that parts of one file can
// have different materials. If only some meshes of the part have texture coordinates, the others
// get zeros. Materials, lines, points, skins and animations in the file are ignored. Triangles
// without area are removed.
//
// Shading normals come from the file (except for STL, which has one normal per triangle). `normals`
// determines the treatment of vertices without a normal:
//
//   file_or_flat     the surface is flat shaded
//   file_or_smooth   a vertex gets the mean of the normals of the triangles around it, weighted by
//                    their angles (Thuermer and Wuethrich 1998), as in Mitsuba
//   flat             flat everywhere: the normals in the file are not used either
//
// Triangles are smoothed across the vertices that they share in the file. A vertex that the file
// stores twice keeps an edge, whether it is a real edge or a seam of the texture. In OBJ files,
// vertices are pairs of a position and a texture coordinate. Triangles of STL files share the
// vertices that agree exactly.
//
// Texture coordinates have their origin at the lower left of the image, as for `bitmap`. In glTF
// and `serialized` files v runs from the top; it is converted, so that images look as their author
// saw them.
//
// A damaged file causes an error that names the faulty place. No count in the file is trusted
// before the bytes are present. glTF files may use all types of numbers, including
// KHR_mesh_quantization. Sparse accessors and EXT_mesh_gpu_instancing are refused by name, as are
// all required extensions except those for materials, textures and lights
// (KHR_draco_mesh_compression, EXT_meshopt_compression, …).
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
          "File with the triangles: .glb, .gltf, .obj, .pbrt, .ply, .serialized or .stl")
      .required();
  s.field("part", &Settings::part, "Read only the mesh or node of this name; empty: everything");
  s.field("shape_index", &Settings::shape_index,
          "Read only the mesh of this number, from 0; .serialized files only")
      .at_least(0);
  s.field("to_world", &Settings::to_world, "Transform from the file's space to world space");
  s.field("flip_normals", &Settings::flip_normals, "Exchange the outer and the inner side");
  s.field("normals", &Settings::normals,
          "Source of shading normals: the file, or computed where it has none");
  s.example("{ file: example.ply, normals: flat, to_world: { scale: [1, -2, 3] } }");
  s.example("{ file: example.ply, normals: file_or_smooth }");
}

Mesh::Mesh(const Settings& settings)
    : TriangleShape(read_mesh_file(settings), settings.file.string()) {}

}  // namespace pharos
