#include "stripes.h"

#include <doctest/doctest.h>

TEST_CASE("stripes alternate") {
  const Stripes stripes({.first = pharos::Rgb(1), .second = pharos::Rgb(0), .count = 4});
  pharos::SurfacePoint point;
  point.uv = {0.1f, 0.5f};
  CHECK(stripes.evaluate(point) == pharos::Rgb(1));
  point.uv = {0.3f, 0.5f};
  CHECK(stripes.evaluate(point) == pharos::Rgb(0));
}
