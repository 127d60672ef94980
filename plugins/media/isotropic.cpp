// isotropic: equal scattering in every direction, 1 / (4 pi) [1/sr].
//
//     phase: isotropic

#include "isotropic.h"

#include <pharos/core/warp.h>

namespace pharos {

float IsotropicPhase::evaluate(Vec3, Vec3) const {
  return warp::sphere_pdf();
}

Vec3 IsotropicPhase::sample(Vec3, Vec2 u) const {
  return warp::sphere_from_square(u);
}

}  // namespace pharos
