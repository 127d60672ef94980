// Maps Mitsuba's shapes to shapes of Pharos. Texture coordinates are the same in both unless stated
// otherwise.
#include <array>

#include <fmt/core.h>

#include "shapes.h"

namespace pharos::mitsuba {
namespace {

Geometry placed_shape(Part& part, const char* type) {
  ConfigNode node = part.node(type);
  part.copy_transform(node, "to_world");
  part.copy_flag(node, "flip_normals");
  return {{std::move(node)}};
}

/// A face of Mitsuba's cube: the directions in which its image's u and v increase. Their cross
/// product points inwards.
struct CubeFace {
  Vec3 u, v;
};
constexpr std::array<CubeFace, 6> kCubeFaces{{{{0, 0, 1}, {1, 0, 0}},
                                              {{-1, 0, 0}, {0, 0, -1}},
                                              {{0, 1, 0}, {0, 0, -1}},
                                              {{0, 1, 0}, {1, 0, 0}},
                                              {{0, 1, 0}, {0, 0, 1}},
                                              {{0, -1, 0}, {1, 0, 0}}}};

/// Returns the map from the square of `quad` to the face, with v upwards as in Pharos.
Transform to_face(const CubeFace& face) {
  const Vec3 x = face.u, y = -face.v, z = cross(x, y);
  return Transform({{{x.x, y.x, z.x, z.x}, {x.y, y.y, z.y, z.y}, {x.z, y.z, z.z, z.z}}});
}

/// Uses the shading normals of the file, and smooth normals where the file has none, unless the
/// faces should be visible.
void set_normals(Part& part, ConfigNode& node) {
  const bool is_flat = part.flag("face_normals", false);
  const Location& there = is_flat ? part.object().find("face_normals")->where : part.where();
  node.set("normals", text_node(is_flat ? "flat" : "file_or_smooth", there), there);
}

/// Maps the properties that all mesh files share.
ConfigNode mesh_of(Part& part) {
  ConfigNode node = part.node("mesh");
  node.set("file", part.file("filename"), part.where());
  part.copy_transform(node, "to_world");
  part.copy_flag(node, "flip_normals");
  set_normals(part, node);
  return node;
}

UvSense flipped_if(bool flipped) {
  return flipped ? UvSense::v_flipped : UvSense::same;
}

}  // namespace

Geometry map_rectangle(Part& part, bool) {
  return placed_shape(part, "quad");
}

/// The images on Mitsuba's cube have another orientation than those on a `box`, so a textured cube
/// becomes six quads.
Geometry map_cube(Part& part, bool has_texture) {
  if (!has_texture) return placed_shape(part, "box");
  const Transform to_world = part.transform("to_world").value_or(Transform());
  const Property* stated = part.object().find("to_world");
  const Location& there = stated != nullptr ? stated->where : part.where();
  Geometry faces{{}, UvSense::v_flipped};
  for (const CubeFace& face : kCubeFaces) {
    ConfigNode node = part.node("quad");
    node.set("to_world", transform_node(to_world * to_face(face), there), there);
    part.copy_flag(node, "flip_normals");
    faces.nodes.push_back(std::move(node));
  }
  return faces;
}

Geometry map_sphere(Part& part, bool) {
  Geometry sphere = placed_shape(part, "sphere");
  if (const std::optional<Vec3> center = part.triple("center")) {
    sphere.nodes[0].set("center", triple_node(*center, part.where()), part.where());
  }
  sphere.nodes[0].set("radius", part.number_or("radius", 1), part.where());
  return sphere;
}

Geometry map_disk(Part& part, bool has_texture) {
  if (has_texture)
    part.note("shape disk: its texture is laid on flat instead of around the center");
  return placed_shape(part, "disk");
}

Geometry map_cylinder(Part& part, bool) {
  Geometry cylinder = placed_shape(part, "cylinder");
  const Vec3 p0 = part.triple("p0").value_or(Vec3{0, 0, 0});
  const Vec3 p1 = part.triple("p1").value_or(Vec3{0, 0, 1});
  cylinder.nodes[0].set("p0", triple_node(p0, part.where()), part.where());
  cylinder.nodes[0].set("p1", triple_node(p1, part.where()), part.where());
  cylinder.nodes[0].set("radius", part.number_or("radius", 1), part.where());
  return cylinder;
}

Geometry map_obj(Part& part, bool) {
  part.ignore({"collapse", "load_materials"});
  Geometry mesh{{mesh_of(part)}};
  mesh.sense = flipped_if(part.flag("flip_tex_coords", true));
  return mesh;
}

Geometry map_ply(Part& part, bool) {
  part.ignore({"srgb"});
  Geometry mesh{{mesh_of(part)}};
  mesh.sense = flipped_if(part.flag("flip_tex_coords", false));
  return mesh;
}

/// The reader of these files flips v.
Geometry map_serialized(Part& part, bool) {
  Geometry mesh{{mesh_of(part)}, UvSense::v_flipped};
  const std::int64_t index = part.integer("shape_index").value_or(0);
  mesh.nodes[0].set("shape_index", text_node(fmt::format("{}", index), part.where()), part.where());
  return mesh;
}

}  // namespace pharos::mitsuba
