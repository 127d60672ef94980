#include "../records.h"

#include <doctest/doctest.h>

#include <pharos/core/warp.h>

namespace pharos::practical_path_guiding {
namespace {

/// Returns a path over one guidable vertex to a lamp of radiance 3: f cos = 0.2, p = 0.5, and
/// throughput 2.
PathLog lit_path(Vec2 film = {}) {
  PathLog log;
  log.begin_path(film, Transport::radiance);
  log.add(RecordedVertex{.throughput = Rgb(1), .local_weight = Rgb(2)});
  log.add(RecordedVertex{.position = {1, 2, 3},
                         .event = Event::smooth_reflect,
                         .guidable = true,
                         .parent = 0,
                         .throughput = Rgb(2),
                         .local_weight = Rgb(0.4f),
                         .direction = {0, 0, 1},
                         .pdf = 0.5f});
  log.add(RecordedVertex{.position = {1, 2, 9}, .parent = 1, .emission = Rgb(3)});
  return log;
}

Record record_of(const PathLog& log, GuidingTarget target, const PixelEstimates& pixels,
                 LightHits hits = LightHits::weighted) {
  std::vector<Record> records;
  std::vector<Rgb> incident;
  extract_records(log[0], target, hits, pixels, incident, records);
  REQUIRE(records.size() == 1);
  return records[0];
}

TEST_CASE("a record says where, whither and what it counts, by target") {
  PixelEstimates pixels({0, 0, 2, 1});
  const Record plain = record_of(lit_path(), GuidingTarget::radiance, pixels);
  CHECK(plain.position == Point3{1, 2, 3});
  CHECK(plain.direction == warp::square_from_sphere({0, 0, 1}));
  CHECK(plain.value == doctest::Approx(3 / 0.5));
  CHECK(plain.steps == 1);
  // The value is x^2 / p with x = f cos L = 0.6.
  const Record product = record_of(lit_path(), GuidingTarget::product, pixels);
  CHECK(product.value == doctest::Approx(0.36 / 0.5));
  // Without pixel estimates, the value is multiplied by the squared throughput.
  const Record first = record_of(lit_path(), GuidingTarget::relative, pixels);
  CHECK(first.value == doctest::Approx(4 * 0.36 / 0.5));
  // Now the value is relative to a pixel of 8, whose neighbor is dark.
  pixels.add({0.5f, 0.5f}, 8);
  pixels.add({1.5f, 0.5f}, 0);
  pixels.update(0, 0.01);
  CHECK(record_of(lit_path(), GuidingTarget::relative, pixels).value ==
        doctest::Approx(4 * 0.36 / 0.5 / 64));
  CHECK(pixels.at({1.5f, 0.5f}) == doctest::Approx(0.04));
}

TEST_CASE("light that a step hits can be left out, and light from further away stays") {
  const PixelEstimates pixels({0, 0, 2, 1});
  const auto value = [&](const PathLog& log, GuidingTarget target, LightHits hits) {
    return record_of(log, target, pixels, hits).value;
  };
  // The lamp of radiance 3 reflects half of a radiance of 4 from behind.
  PathLog log = lit_path();
  log.vertex(2).event = Event::smooth_reflect;
  log.vertex(2).local_weight = Rgb(0.5f);
  log.add(RecordedVertex{.position = {1, 2, 0}, .parent = 2, .emission = Rgb(4)});
  using enum LightHits;
  for (const auto target :
       {GuidingTarget::radiance, GuidingTarget::product, GuidingTarget::relative}) {
    CHECK(value(lit_path(), target, left_out) == 0);
    const double all = value(log, target, weighted), rest = value(log, target, left_out);
    const double share = rest / all;
    CHECK(share == doctest::Approx(target == GuidingTarget::radiance ? 0.4 : 0.16));
  }
}

}  // namespace
}  // namespace pharos::practical_path_guiding
