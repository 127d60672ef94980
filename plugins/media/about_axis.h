#pragma once

#include <cmath>

#include <pharos/core/frame.h>

namespace pharos {

/// The unit direction at an angle of 1 - cos = `one_minus_cos`, in [0, 2], to a unit axis, turned
/// around it by `turn` of a full turn.
inline Vec3 about_axis(Vec3 axis, float one_minus_cos, float turn) {
  const float sine = safe_sqrt(one_minus_cos * (2 - one_minus_cos));
  const float phi = 2 * kPi * turn;
  return Frame::from_normal(axis).to_world(
      {sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cos});
}

}  // namespace pharos
