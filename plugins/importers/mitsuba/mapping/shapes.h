#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Maps a shape and appends the result to `entries`: nothing for a group, which instances show,
/// several entries for a textured cube, and one entry for other shapes.
void map_shape(SceneMap& scene, const Object& shape, std::vector<ConfigNode>& entries);

/// The geometry of one shape, before it gets a material.
struct Geometry {
  std::vector<ConfigNode> nodes;
  UvSense sense = UvSense::same;
};

// These functions map the geometry of each type; see docs/mitsuba.md. `has_texture` states whether
// the shape's material or emitter uses its texture coordinates.
Geometry map_rectangle(Part& part, bool has_texture);
Geometry map_cube(Part& part, bool has_texture);
Geometry map_sphere(Part& part, bool has_texture);
Geometry map_disk(Part& part, bool has_texture);
Geometry map_cylinder(Part& part, bool has_texture);
Geometry map_obj(Part& part, bool has_texture);
Geometry map_ply(Part& part, bool has_texture);
Geometry map_serialized(Part& part, bool has_texture);

}  // namespace pharos::mitsuba
