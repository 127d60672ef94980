// bump_map: a material that is shaded as if its surface were displaced along the shading normal by
// `height` times the mean color of `texture` (Blinn 1978, "Simulation of Wrinkled Surfaces"). The
// surface itself stays in place, so outlines and shadows do not change.
//
// With the displacement h, the normal n is tilted to n - grad h. The gradient runs along the
// surface and follows from the derivatives of h and of the position with respect to the texture
// coordinates. The curvature of the surface is ignored, because h is small. Derivatives of h are
// central differences over +-`step`, which blur finer details. A negative `height` turns bumps into
// dents. `height` is in units of the world: bumps on a scaled group become flatter or steeper. If
// texture coordinates have no derivative, nothing is tilted.
//
// Light that the tilted surface would send through the surface itself is lost. A steep bump map
// therefore looks darker at a slanted view. Light directions get the same correction as for shading
// normals.
//
//     type: bump_map
//     texture: { type: bitmap, file: leather.png, color_space: linear }
//     height: 0.02
//     bsdf: { type: rough_plastic, alpha: 0.2 }
#include "bump_map.h"

#include <pharos/config/registry.h>

namespace pharos {

void BumpMap::Settings::describe(Schema<Settings>& s) {
  s.field("bsdf", &Settings::bsdf, "Nested material, whose shading frame is tilted")
      .otherwise("{ type: diffuse }");
  s.field("texture", &Settings::texture, "Height map: the mean of its channels is the height")
      .required();
  s.field("height", &Settings::height,
          "Factor on the texture; a negative one turns bumps into dents")
      .unit("scene units");
  s.field("step", &Settings::step,
          "Half width in texture coordinates of the differences that give slopes")
      .above(0)
      .at_most(0.25);
  s.example("{ texture: { type: bitmap, file: example.png }, height: 0.1, step: 0.01 }");
  s.example(
      "{ texture: { type: bitmap, file: example.png }, height: -0.3, step: 0.02, "
      "bsdf: { type: rough_conductor, alpha: 0.1, alpha_v: 0.4 } }");
  s.example(
      "{ texture: { type: bitmap, file: example.png }, height: 0.2, step: 0.01, "
      "bsdf: { type: rough_dielectric, alpha: 0.3 } }");
  s.example(
      "{ texture: { type: bitmap, file: example.png }, height: 0.2, step: 0.01, "
      "bsdf: { type: mask, bsdf: { type: dielectric } } }");
}

float BumpMap::height_beside(const SurfacePoint& point, Vec2 offset) const {
  SurfacePoint beside = point;
  beside.uv = point.uv + offset;
  beside.position = point.position + offset.x * point.tangents.du + offset.y * point.tangents.dv;
  return settings_.height * mean(settings_.texture->evaluate(beside));
}

Vec3 BumpMap::normal(const SurfacePoint& point) const {
  const Vec3 du = point.shading.to_local(point.tangents.du);
  const Vec3 dv = point.shading.to_local(point.tangents.dv);
  const float determinant = du.x * dv.y - du.y * dv.x;
  if (determinant == 0) return {0, 0, 1};
  const float step = settings_.step;
  const float by_u =
      (height_beside(point, {step, 0}) - height_beside(point, {-step, 0})) / (2 * step);
  const float by_v =
      (height_beside(point, {0, step}) - height_beside(point, {0, -step})) / (2 * step);
  return {(by_v * du.y - by_u * dv.y) / determinant, (by_u * dv.x - by_v * du.x) / determinant, 1};
}

}  // namespace pharos
