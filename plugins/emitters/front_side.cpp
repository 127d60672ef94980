#include "front_side.h"

#include <algorithm>

namespace pharos {

FrontSide::FrontSide(const Shape& shape) {
  const TriangleMesh* mesh = shape.mesh();
  if (mesh == nullptr || mesh->facts.empty()) return;
  constexpr float kSameNormal = 1e-6f;
  const TriangleFacts& first = mesh->facts.front();
  float error = 0;
  for (const TriangleFacts& f : mesh->facts) {
    if (max_component(abs(f.normal - first.normal)) > kSameNormal) return;
    for (const Vec3 corner : {Vec3{}, f.edge1, f.edge2}) {
      const float off = dot(f.origin + corner - first.origin, first.normal);
      error = std::max(error, std::abs(off) + f.error);
    }
  }
  point_ = first.origin;
  normal_ = first.normal;
  error_ = error;
}

}  // namespace pharos
