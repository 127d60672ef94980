// normal_map: a material whose shading normal is read from a picture. Red, green and blue in [0, 1]
// encode components in [-1, 1]: along dp/du, along dp/dv (its part orthogonal to dp/du), and along
// the shading normal. The color (0.5, 0.5, 1) tilts nothing, although 8 bits cannot represent 0.5
// exactly. The length of the vector does not matter. Green increases with v, from the bottom of the
// picture to its top; maps made for the other direction have to be inverted. If texture coordinates
// are mirrored, as on mirrored halves of a model, green still follows v. Such pictures are linear:
// 8-bit files need `color_space: linear`.
//
// A steep map loses light as bump_map does. If texture coordinates have no derivative, nothing is
// tilted.
//
//     type: normal_map
//     texture: { type: bitmap, file: bricks_normal.png, color_space: linear }
//     bsdf: { type: diffuse, reflectance: [0.5, 0.2, 0.1] }
#include "normal_map.h"

#include <pharos/config/registry.h>

namespace pharos {

void NormalMap::Settings::describe(Schema<Settings>& s) {
  s.field("bsdf", &Settings::bsdf, "Nested material, whose shading frame is tilted")
      .otherwise("{ type: diffuse }");
  s.field("texture", &Settings::texture, "Picture of normals, in linear color")
      .required()
      .check("at most 1 everywhere",
             [](const Ref<Texture>& t) { return max_component(t->maximum()) <= 1; });
  s.example("{ texture: [0.6, 0.35, 0.9] }");
  s.example(
      "{ texture: { type: bitmap, file: example.png, color_space: linear }, "
      "bsdf: { type: rough_plastic, alpha: 0.3 } }");
  s.example("{ texture: [0.4, 0.7, 1], bsdf: { type: rough_dielectric, alpha: 0.3 } }");
  s.example(
      "{ texture: [0.4, 0.45, 1], bsdf: { type: normal_map, texture: [0.5, 0.6, 1], "
      "bsdf: { type: two_sided, bsdf: { type: plastic } } } }");
}

Vec3 NormalMap::normal(const SurfacePoint& point) const {
  if (point.tangents.du == Vec3{}) return {0, 0, 1};
  const Rgb c = texture_->evaluate(point);
  const bool mirrored = dot(point.tangents.dv, point.shading.t) < 0;
  const float along_v = 2 * c.g - 1;
  return {2 * c.r - 1, mirrored ? -along_v : along_v, 2 * c.b - 1};
}

}  // namespace pharos
