#include "../document.h"

#include <doctest/doctest.h>
TEST_CASE("x") {
  for (auto f : {"/work/shared/references/fog.xml"}) pharos::mitsuba::read_document(f);
}
