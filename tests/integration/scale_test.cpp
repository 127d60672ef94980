// Nothing depends on the scale of a scene: multiplying every length by a power of two does not
// change the image.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"

namespace pharos::testing {
namespace {

/// Returns a scene with two walls, a ball and a light, scaled by `s`.
std::string room(double s) {
  return fmt::format(
      R"(
scene:
  shapes:
    - {{ type: quad, to_world: [ {{ scale: {0} }}, {{ rotate: {{ axis: [1, 0, 0], degrees: -90 }} }} ] }}
    - {{ type: quad, to_world: [ {{ scale: {0} }}, {{ translate: [0, {0}, -{0}] }} ] }}
    - {{ type: sphere, center: [0, {1}, 0], radius: {2}, material: dielectric }}
    - {{ type: quad, to_world: [ {{ scale: {2} }}, {{ rotate: {{ axis: [1, 0, 0], degrees: 90 }} }}, {{ translate: [0, {3}, 0] }} ], emitter: {{ type: area, radiance: 5 }} }}
  sensor: {{ type: perspective, fov: 60, to_world: {{ look_at: {{ origin: [0, {0}, {3}], target: [0, {2}, 0], up: [0, 1, 0] }} }} }}
film: {{ width: 48, height: 48, filter: box }}
integrator: {{ type: path, max_depth: 8 }}
sampler: independent
budget: {{ spp: 4 }}
)",
      s, 0.5 * s, 0.4 * s, 2 * s);
}

TEST_CASE("powers of two change no bit") {
  const RenderResult unit = render(room(1));
  CHECK(image_mean(unit.image) > 0.05);
  for (const double scale : {1024.0, 1.0 / 4096}) {
    const RenderResult scaled = render(room(scale));
    int different = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 48; ++x) {
        different += !(unit.image.rgb(x, y) == scaled.image.rgb(x, y));
      }
    }
    CHECK_MESSAGE(different == 0, "scale " << scale);
  }
}

}  // namespace
}  // namespace pharos::testing
