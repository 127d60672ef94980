#include "../sample.h"

#include <array>

#include <doctest/doctest.h>

namespace pharos::spatial_gaussians {
namespace {

/// Returns a path from the lens to the vertex `at`, at the origin, and on to `end`.
PathLog path_to(RecordedVertex at, RecordedVertex end, Transport transport = Transport::radiance) {
  PathLog log;
  log.begin_path({}, transport);
  log.add(RecordedVertex{.throughput = Rgb(1)});
  at.parent = 0;
  at.direction = {0, 0, 1};
  at.local_weight = Rgb(0.5f);
  log.add(at);
  end.parent = 1;
  log.add(end);
  return log;
}

const RecordedVertex kVertex{.event = Event::smooth_reflect, .guidable = true, .pdf = 0.5f};
const RecordedVertex kLamp{.position = {0, 0, 2}, .emission = Rgb(3)};

std::vector<Sample> samples_of(const PathLog& log) {
  std::vector<Sample> samples;
  std::vector<Rgb> incident;
  extract_samples(log[0], {.least_pdf = 0.1f, .environment_distance = 10}, incident, samples);
  return samples;
}

TEST_CASE("a step is a sample of radiance over density") {
  const std::vector<Sample> samples = samples_of(path_to(kVertex, kLamp));
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].target == Point3{0, 0, 2});
  CHECK(samples[0].pdf == 0.5f);
  CHECK(samples[0].weight == 6);
  RecordedVertex dark = kLamp;
  dark.emission = Rgb();
  REQUIRE(samples_of(path_to(kVertex, dark)).size() == 1);
  CHECK(samples_of(path_to(kVertex, dark))[0].weight == 0);
}

TEST_CASE("the density is that of guide and scattering together, and not below its floor") {
  const std::array techniques{Technique{0.25f, 0.5f}, Technique{0.75f, 1.5f}};
  RecordedVertex guided = kVertex;
  guided.pdf = 0.25f * 0.5f + 0.75f * 1.5f;
  PathLog log = path_to(guided, kLamp);
  log.set_techniques(1, techniques);
  CHECK(samples_of(log)[0].pdf == 1.25f);
  RecordedVertex rare = kVertex;
  rare.pdf = 0.01f;
  const Sample sample = samples_of(path_to(rare, kLamp))[0];
  CHECK(sample.pdf == 0.1f);
  CHECK(sample.weight == doctest::Approx(30));
}

TEST_CASE("in media weights have transmittance and the density of the length, densities do not") {
  RecordedVertex foggy = kVertex;
  foggy.pdf = 0.5f * 0.2f;
  foggy.medium_density = 0.2f;
  foggy.transmittance = Rgb(0.4f);
  const Sample sample = samples_of(path_to(foggy, kLamp))[0];
  CHECK(sample.pdf == doctest::Approx(0.5));
  CHECK(sample.weight == doctest::Approx(3 * 0.4 / (0.5 * 0.2)));
}

TEST_CASE("the environment stands at its distance along the ray") {
  RecordedVertex sky = kLamp;
  sky.kind = VertexKind::environment;
  CHECK(samples_of(path_to(kVertex, sky))[0].target == Point3{0, 0, 10});
}

TEST_CASE("branches of a vertex weigh as much as one step, and survivors as much as all steps") {
  RecordedVertex branch = kVertex;
  branch.continuation = 0.5f;
  PathLog split = path_to(branch, kLamp);
  RecordedVertex other = split[0].vertices[1];
  other.next = kNoVertex;
  other.branch = 1;
  RecordedVertex bright = kLamp;
  bright.emission = Rgb(9);
  bright.parent = split.add(other);
  split.add(bright);
  const std::vector<Sample> samples = samples_of(split);
  REQUIRE(samples.size() == 2);
  // Whole steps weigh 3 / 0.5 and 9 / 0.5. Densities know nothing of branches.
  CHECK(samples[0].weight == doctest::Approx(6 * 0.5));
  CHECK(samples[1].weight == doctest::Approx(18 * 0.5));
  for (const Sample& sample : samples) CHECK(sample.pdf == 0.5f);

  RecordedVertex survivor = kVertex;
  survivor.continuation = 4;
  CHECK(samples_of(path_to(survivor, kLamp))[0].weight == doctest::Approx(6 * 4));
  CHECK(samples_of(path_to(survivor, kLamp))[0].pdf == 0.5f);
}

TEST_CASE("steps that no guide makes are no samples") {
  RecordedVertex mirror = kVertex;
  mirror.event = Event::discrete_reflect;
  CHECK(samples_of(path_to(mirror, kLamp)).empty());
  RecordedVertex unguidable = kVertex;
  unguidable.guidable = false;
  CHECK(samples_of(path_to(unguidable, kLamp)).empty());
  RecordedVertex same_place = kLamp;
  same_place.position = {};
  CHECK(samples_of(path_to(kVertex, same_place)).empty());
  CHECK(samples_of(path_to(kVertex, kLamp, Transport::importance)).empty());
}

}  // namespace
}  // namespace pharos::spatial_gaussians
