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

Record record_of(const PathLog& log, GuidingTarget target, const PixelEstimates& pixels) {
  std::vector<Record> records;
  std::vector<Rgb> incident;
  extract_records(log[0], target, pixels, incident, records);
  REQUIRE(records.size() == 1);
  return records[0];
}

TEST_CASE("a record says where, whither and what it counts, by target") {
  PixelEstimates pixels({0, 0, 2, 1});
  const Record plain = record_of(lit_path(), GuidingTarget::radiance, pixels);
  CHECK(plain.position == Point3{1, 2, 3});
  CHECK(plain.direction == warp::square_from_sphere({0, 0, 1}));
  CHECK(plain.value == doctest::Approx(3 / 0.5));
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

}  // namespace
}  // namespace pharos::practical_path_guiding
