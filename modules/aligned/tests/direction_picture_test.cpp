#include "../direction_picture.h"

#include <doctest/doctest.h>

namespace pharos::aligned {

TEST_CASE("direction pictures: segments at the directions' angles, nothing where there is none") {
  Image render(32, 16, {"R", "G", "B"});
  for (float& v : render.values()) v = 0.5f;
  FreeDirections rising;
  rising.add(45);
  const DirectionField field(block_regions({32, 16}, 16), {{Purpose::light_position, 1}},
                             {rising, {}});
  const Image picture = direction_picture(render, field, 0, 4);
  REQUIRE(picture.width() == 128);
  REQUIRE(picture.height() == 64);
  const Rgb beneath = picture.rgb(0, 0);
  CHECK(beneath.r < 0.5f);
  // The segment rises to the right, because row numbers increase downward.
  for (const int along : {0, 10, -10}) {
    CHECK_FALSE(picture.rgb(32 + along, 31 - along) == beneath);
  }
  CHECK(picture.rgb(32 + 10, 31 + 10) == beneath);
  CHECK(picture.rgb(32 + 28, 31 - 28) == beneath);
  for (int y = 0; y < 64; ++y) {
    for (int x = 64; x < 128; ++x) REQUIRE(picture.rgb(x, y) == beneath);
  }
}

}  // namespace pharos::aligned
