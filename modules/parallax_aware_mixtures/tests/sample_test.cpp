#include "../sample.h"

#include <cmath>

#include <doctest/doctest.h>

namespace pharos::parallax_aware_mixtures {
namespace {

/// Returns the samples of a path from the lens over a guidable vertex at the origin and a surface 3
/// units above it to a lamp 4 units further.
std::vector<Sample> samples_over(RecordedVertex surface, Vec3 onward,
                                 VertexKind end = VertexKind::surface) {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.throughput = Rgb(1)});
  log.add(RecordedVertex{.event = Event::smooth_reflect,
                         .guidable = true,
                         .parent = 0,
                         .local_weight = Rgb(1),
                         .direction = {0, 0, 1},
                         .pdf = 0.5f});
  surface.position = {0, 0, 3};
  surface.normal = {0, 0, -1};
  surface.parent = 1;
  surface.local_weight = Rgb(0.5f);
  surface.direction = onward;
  log.add(surface);
  log.add(RecordedVertex{
      .position = surface.position + 4.0f * onward, .kind = end, .parent = 2, .emission = Rgb(6)});
  std::vector<Sample> samples;
  PathScratch scratch;
  extract_samples(log[0], {.least_pdf = 0.1f, .glossy = 0.3f}, scratch, samples);
  return samples;
}

TEST_CASE("samples have the radiance over its density, and how far away the light is") {
  const auto rough = samples_over({.event = Event::smooth_reflect}, {0.6f, 0, -0.8f});
  REQUIRE(rough.size() == 1);
  CHECK(rough[0].weight == doctest::Approx(3 / 0.5));
  CHECK(rough[0].pdf == 0.5f);
  CHECK(rough[0].direction == Vec3{0, 0, 1});
  CHECK(rough[0].inverse_distance == doctest::Approx(1.0 / 3));
}

TEST_CASE("distances are those of images: past mirrors and smooth surfaces, through glass") {
  const Vec3 back{0.6f, 0, -0.8f};
  const auto inverse = [&](RecordedVertex surface, Vec3 onward) {
    return samples_over(surface, onward)[0].inverse_distance;
  };
  CHECK(inverse({.event = Event::discrete_reflect}, back) == doctest::Approx(1.0 / 7));
  CHECK(inverse({.event = Event::smooth_reflect, .roughness = 0.1f}, back) ==
        doctest::Approx(1.0 / 7));
  // Refraction straight ahead into a medium of index 1.5: the part behind the surface appears
  // shorter by this factor.
  CHECK(inverse({.event = Event::discrete_transmit, .eta = 1.5f}, {0, 0, 1}) ==
        doctest::Approx(1 / (3 + 4 / 1.5)));
  const auto sky = samples_over({.event = Event::discrete_reflect}, back, VertexKind::environment);
  CHECK(sky[0].inverse_distance == 0);
}

}  // namespace
}  // namespace pharos::parallax_aware_mixtures
