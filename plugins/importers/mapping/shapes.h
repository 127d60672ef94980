#pragma once

#include "part.h"

namespace pharos::mitsuba {

/// Appends to `entries` what stands for a shape: nothing for a group, which instances show, one
/// entry for most, several for a textured cube.
void map_shape(SceneMap& scene, const Object& shape, std::vector<ConfigNode>& entries);

/// The geometry of one shape, before it gets a material.
struct Geometry {
  std::vector<ConfigNode> nodes;
  UvSense sense = UvSense::same;
};

// What stands for the geometry of each type; see docs/mitsuba.md. `has_texture` tells whether the
// shape's material or emitter looks at its texture coordinates.
Geometry map_rectangle(Part& part, bool has_texture);
Geometry map_cube(Part& part, bool has_texture);
Geometry map_sphere(Part& part, bool has_texture);
Geometry map_disk(Part& part, bool has_texture);
Geometry map_cylinder(Part& part, bool has_texture);
Geometry map_obj(Part& part, bool has_texture);
Geometry map_ply(Part& part, bool has_texture);
Geometry map_serialized(Part& part, bool has_texture);

}  // namespace pharos::mitsuba
