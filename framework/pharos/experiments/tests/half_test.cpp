// Tests of half precision numbers against IEEE 754 binary16.

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/experiments/report/half.h>

namespace pharos {
namespace {

TEST_CASE("every half survives a float") {
  for (int bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const float value = float_from_half(half);
    CAPTURE(bits);
    if ((bits & 0x7fff) > 0x7c00) {
      CHECK(std::isnan(value));
      CHECK((half_from_float(value) & 0x7fff) == 0x7e00);
    } else {
      CHECK(half_from_float(value) == half);
    }
  }
}

TEST_CASE("halfs stand for the numbers of the standard") {
  CHECK(float_from_half(0x3c00) == 1.0f);
  CHECK(float_from_half(0xc000) == -2.0f);
  CHECK(float_from_half(0x7bff) == kLargestHalf);
  CHECK(float_from_half(0x0400) == 0x1p-14f);
  CHECK(float_from_half(0x0001) == 0x1p-24f);
  CHECK(float_from_half(0x7c00) == std::numeric_limits<float>::infinity());
  CHECK(std::signbit(float_from_half(0x8000)));
}

TEST_CASE("floats become the nearest half, ties the even one") {
  for (int bits = 0; bits < 0x7bff; ++bits) {
    const auto low = static_cast<std::uint16_t>(bits), high = static_cast<std::uint16_t>(bits + 1);
    const float middle = (float_from_half(low) + float_from_half(high)) / 2;
    CAPTURE(bits);
    CHECK(half_from_float(middle) == (bits % 2 == 0 ? low : high));
    CHECK(half_from_float(std::nextafter(middle, 0.0f)) == low);
    CHECK(half_from_float(std::nextafter(middle, kLargestHalf)) == high);
    CHECK(half_from_float(-middle) == (half_from_float(middle) | 0x8000));
  }
}

TEST_CASE("floats out of range become infinity or zero") {
  CHECK(half_from_float(std::nextafter(65520.0f, 0.0f)) == 0x7bff);
  CHECK(half_from_float(65520) == 0x7c00);
  CHECK(half_from_float(1e30f) == 0x7c00);
  CHECK(half_from_float(-std::numeric_limits<float>::infinity()) == 0xfc00);
  CHECK(half_from_float(0x1p-25f) == 0);  // a tie between zero and the smallest half; zero is even
  CHECK(half_from_float(std::nextafter(0x1p-25f, 1.0f)) == 1);
  CHECK(half_from_float(-1e-30f) == 0x8000);
}

}  // namespace
}  // namespace pharos
