// area: a shape that emits light. Every point sends `scale` times the texture `radiance` [W/(m^2
// sr)] in every direction on the side of its normal, and nothing to the other side. A color or a
// number may replace the texture.
//
//     type: quad
//     emitter: { type: area, radiance: [4, 3, 2], scale: 10 }

#include "area.h"

#include <pharos/core/warp.h>

#include "area_light.h"

namespace pharos {
namespace {

/// Equal emission in all directions.
struct UniformLobe {
  float operator()(float) const { return 1; }
  float projected_solid_angle() const { return kPi; }
  Vec3 sample(Vec2 u) const { return warp::cosine_hemisphere_from_square(u); }
  float pdf(float cosine) const { return warp::cosine_hemisphere_pdf(cosine); }
};

}  // namespace

void AreaEmitter::Settings::describe(Schema<Settings>& s) {
  describe_radiance(s, "Radiance on the side of the normal");
  s.example("{ radiance: [4, 3, 2], scale: 10 }");
}

std::unique_ptr<const Light> AreaEmitter::place(const EmitterSite& site) const {
  return std::make_unique<const AreaLight<UniformLobe>>(*settings_.radiance, settings_.scale,
                                                        UniformLobe{}, site);
}

}  // namespace pharos
