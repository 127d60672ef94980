#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/lanes3.h>
#include <pharos/core/random.h>
#include <pharos/core/simd.h>
#include <pharos/core/vec.h>
#include <pharos/core/warp.h>

namespace pharos {
namespace {

TEST_CASE("exponentials side by side are those of the standard library") {
  double worst8 = 0, worst2 = 0, worst_double = 0;
  for (double x = -86; x < 88; x += 0.0137) {
    const auto f = static_cast<float>(x);
    const double expected8 = std::exp(double{f}), expected2 = std::exp2(double{f}),
                 expected_double = std::exp(8 * x);
    worst8 = std::max(worst8, std::abs(exp(all8(f))[5] / expected8 - 1));
    worst2 = std::max(worst2, std::abs(exp2(all8(f))[1] / expected2 - 1));
    worst_double =
        std::max(worst_double, std::abs(exp(all_doubles8(8 * x))[5] / expected_double - 1));
  }
  CHECK(worst2 < 3e-7);
  CHECK(worst8 < 1e-5);
  CHECK(worst_double < 1e-15);
  CHECK(exp(all8(-90.0f))[0] == 0);
  CHECK(exp(all8(-kInfinity))[0] == 0);
  CHECK(exp(all_doubles8(-1e300))[0] == 0);
  CHECK(exp(Float8{})[7] == 1);
}

TEST_CASE("logarithms side by side are those of the standard library") {
  double worst = 0;
  for (double x = -708; x < 709; x += 0.00137) {
    for (const double of : {std::exp(x), 1 + x / 709}) {
      if (of < 1e-300) continue;
      const double expected = std::log(of), error = std::abs(log(all_doubles8(of))[3] - expected);
      worst = std::max(worst, error / std::max(1.0, std::abs(expected)));
    }
  }
  CHECK(worst < 1e-15);
  CHECK(log(all_doubles8(1))[0] == 0);
  CHECK(log(load8(std::array{1.0, 2.0, 4.0, 0.5, 8.0, 1.0, 1.0, 1024.0}.data()))[7] ==
        doctest::Approx(std::log(1024.0)).epsilon(1e-15));
}

TEST_CASE("lanes are loaded, rounded, compared and summed element by element") {
  const double doubles[8] = {0.1, -0.2, 0.3, -0.4, 1, 2, 3, 4};
  const Float8 f{1, -2, 3, -4, 5, -6, 7, -8};
  const Double8 d = load8(doubles);
  CHECK(sum(f) == -4);
  CHECK(sum(d) == doctest::Approx(9.8).epsilon(1e-15));
  CHECK((2 * d - 1)[6] == 5);
  CHECK((1 - d)[7] == -3);
  CHECK(larger(d, all_doubles8(2.5))[1] == 2.5);
  CHECK(larger(d, all_doubles8(2.5))[7] == 4);
  CHECK(all_below(d, 4.5));
  CHECK(!all_below(d, 4));
  CHECK(!all_below(d + all_doubles8(NAN), 4.5));
  const Double8 both = widened(Float8{0.1f, -0.2f, 0.3f, -0.4f, 1.1f, 0.8f, 1.3f, 0.6f});
  CHECK(rounded(both)[2] == 0.3f);
  CHECK(rounded(both)[5] == 0.8f);
  CHECK(rounded((both + both) * both / both - both)[7] == 0.6f);
  CHECK(rounded(-all_doubles8(-4))[1] == 4);
  CHECK(rounded(widened(f))[6] == 7);
  CHECK(larger(f, Float8{})[1] == 0);
  CHECK(bits_of(f < 0) == 0b10101010);
  CHECK(absolute(f)[1] == 2);
  CHECK(sqrt(f * f)[3] == 4);
  CHECK(any(f > 6.5f));
  CHECK(!any(f > 7.5f));
}

TEST_CASE("operations on eight vectors side by side agree with operations on Vec3") {
  RandomStream random(5);
  Lanes3<Float8> a, b;
  for (unsigned lane = 0; lane < 8; ++lane) {
    const Vec3 n = lane == 0 ? Vec3{0, 0, -1} : warp::sphere_from_square(random.next_2d());
    const Vec3 other = warp::sphere_from_square(random.next_2d());
    for (int axis = 0; axis < 3; ++axis) {
      (axis == 0 ? a.x : axis == 1 ? a.y : a.z)[lane] = n[axis];
      (axis == 0 ? b.x : axis == 1 ? b.y : b.z)[lane] = other[axis];
    }
  }
  const Float8 products = dot(a, b);
  const Lanes3<Float8> crossed = cross(a, b), difference = all8(3) * a - all8(Vec3{1, 2, 3});
  const std::array<Lanes3<Float8>, 2> frame = perpendicular(a);
  for (unsigned lane = 0; lane < 8; ++lane) {
    const Vec3 n = lane_of(a, lane), other = lane_of(b, lane);
    CHECK(products[lane] == doctest::Approx(dot(n, other)).epsilon(1e-5));
    CHECK(length(lane_of(crossed, lane) - cross(n, other)) < 1e-6f);
    CHECK(length(lane_of(difference, lane) - (3.0f * n - Vec3{1, 2, 3})) < 1e-6f);
    const Vec3 s = lane_of(frame[0], lane), t = lane_of(frame[1], lane);
    CHECK(length(cross(s, t) - n) < 1e-6f);
    CHECK(length(s) == doctest::Approx(1));
    CHECK(length(t) == doctest::Approx(1));
  }
}

}  // namespace
}  // namespace pharos
