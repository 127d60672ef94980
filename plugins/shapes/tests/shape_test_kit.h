#pragma once

#include <memory>
#include <utility>

#include <pharos/tests/scene_fixtures.h>

/// Helpers that the tests of this folder share.
namespace pharos::test {

template <class S>
std::unique_ptr<const Scene> scene_of(typename S::Settings settings) {
  SceneParts parts;
  parts.objects.push_back(object_of(std::make_shared<const S>(std::move(settings))));
  return std::make_unique<const Scene>(std::move(parts));
}

/// Returns a direction on the side of `normal`. Every other direction is grazing, with cosines down
/// to 1e-3. (At 1e-5 and below, one ray in millions that runs along an edge, at a distance of the
/// order of rounding, slips past it in Embree.)
inline Vec3 random_departure(Vec3 normal, RandomStream& random) {
  const Frame frame = Frame::from_normal(normal);
  for (;;) {
    Vec3 local = warp::cosine_hemisphere_from_square(random.next_2d());
    if (random.next_1d() < 0.5f) local.z *= std::exp(-7 * random.next_1d());
    const Vec3 direction = normalize(frame.to_world(local));
    if (dot(direction, normal) > 0) return direction;
  }
}

}  // namespace pharos::test
