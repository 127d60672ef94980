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
      const Vec3 way = f.origin + corner - first.origin;
      error = std::max(error, std::abs(dot(way, first.normal)) + f.error + rounding(way));
    }
  }
  point_ = first.origin;
  normal_ = first.normal;
  error_ = error;
}

}  // namespace pharos
