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
                         .parent = 0,
                         .throughput = Rgb(2),
                         .local_weight = Rgb(0.4f),
                         .direction = {0, 0, 1},
                         .unguided_pdf = 0.5f,
                         .guidable = true});
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

TEST_CASE("pixels are averaged with their neighbors, and add up when merged") {
  PixelEstimates a({4, 2, 7, 3}), b = a;
  a.add({4.5f, 2.5f}, 3);
  b.add({5.5f, 2.5f}, 1);
  a.merge(b);
  a.update(1, 1e-6);
  CHECK(a.at({4.2f, 2.9f}) == doctest::Approx(2));
  CHECK(a.at({5.2f, 2.9f}) == doctest::Approx(2));
  CHECK(a.at({6.2f, 2.9f}) == doctest::Approx(1));
  CHECK(a.at({99, 99}) == a.at({6.2f, 2.9f}));
  CHECK_THROWS_AS(a.merge(PixelEstimates({0, 0, 3, 1})), InputError);
}

}  // namespace
}  // namespace pharos::practical_path_guiding
