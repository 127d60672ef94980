#include "query.h"

#include <bit>

#include <pharos/core/random.h>

namespace pharos::open_pgl {
namespace {

/// Returns the number in [0,1) that the library uses to choose one of the neighboring cells. It
/// depends on the position alone, because a vertex must get the same cell in every query.
float neighbor_number(Point3 p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash = hash_combine(hash, std::bit_cast<std::uint32_t>(p[axis] + 0.0f));  // -0 is 0
  }
  return to_unit_vec2(hash).x;
}

}  // namespace

bool Workplace::take(const Query& query) {
  if (holds_ && query == taken_) return true;
  float number = neighbor_number(query.position);
  const pgl_point3f at = to_point(query.position);
  holds_ = query.in_volume ? volume_.Init(&field_, at, number) : surface_.Init(&field_, at, number);
  if (!holds_) return false;
  taken_ = query;
  const bool multiplies = !query.in_volume && query.cosine_about != Vec3{};
  if (multiplies && surface_.SupportsApplyCosineProduct()) {
    surface_.ApplyCosineProduct(to_vector(query.cosine_about));
  }
  return true;
}

Vec3 Workplace::sample(Vec2 u) const {
  const pgl_point2f number = openpgl::cpp::Point2(u.x, u.y);
  const pgl_vec3f w = taken_.in_volume ? volume_.Sample(number) : surface_.Sample(number);
  return normalize(Vec3{w.x, w.y, w.z});
}

float Workplace::pdf(Vec3 direction) const {
  const pgl_vec3f w = to_vector(direction);
  return taken_.in_volume ? volume_.PDF(w) : surface_.PDF(w);
}

}  // namespace pharos::open_pgl
