#pragma once

#include <pharos/core/vec.h>

namespace pharos {

/// A half-line or segment. `direction` has unit length, so t is a distance [scene units].
struct Ray {
  Point3 origin;
  Vec3 direction;
  float t_max = kInfinity;

  Point3 at(float t) const { return origin + t * direction; }
};

}  // namespace pharos
