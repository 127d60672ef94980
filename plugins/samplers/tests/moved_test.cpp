// Samplers that move the points of other samplers: sheared, toroidal_shift.
#include <cmath>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/statistics/goodness_of_fit.h>
#include <pharos/statistics/hypothesis.h>

#include "../multi_jittered.h"
#include "../sheared.h"
#include "../sobol.h"
#include "../toroidal_shift.h"
#include "point_lists.h"

namespace pharos {
namespace {

constexpr SamplePlan kPlan{.samples_per_pixel = 64};
constexpr Dimension kLight{Purpose::light_position, 2};

/// A sampler whose numbers are all the same.
class FixedSampler final : public Sampler {
 public:
  explicit FixedSampler(float number) : number_(number) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid&, const SamplePlan&,
                                                 const IntegrandProbe*) const override {
    return std::make_unique<Prepared>(number_);
  }

 private:
  class Prepared final : public PreparedSampler {
   public:
    explicit Prepared(float number) : number_(number) {}
    std::uint64_t begin(const PathKey&) const override { return 0; }
    float value_1d(const SampleStream&, Dimension) const override { return number_; }
    Vec2 value_2d(const SampleStream&, Dimension) const override { return {number_, number_}; }

   private:
    float number_;
  };
  float number_;
};

std::unique_ptr<const PreparedSampler> sheared(double direction) {
  const ShearedSampler::Settings settings{.base = std::make_shared<MultiJitteredSampler>(),
                                          .direction = direction};
  return ShearedSampler(settings).prepare({}, kPlan, nullptr);
}

std::unique_ptr<const PreparedSampler> shifted() {
  return ToroidalShiftSampler({.base = std::make_shared<MultiJitteredSampler>()})
      .prepare({}, kPlan, nullptr);
}

double fraction(double v) {
  return v - std::floor(v);
}

/// Returns whether the values x * slope_x + y * slope_y, modulo one, lie one each in as many
/// intervals as there are points.
bool is_stratified(const std::vector<Vec2>& points, double slope_x, double slope_y) {
  std::vector<int> counts(points.size());
  for (const Vec2 p : points) {
    const double along = fraction(p.x * slope_x + p.y * slope_y);
    ++counts[static_cast<std::size_t>(along * static_cast<double>(points.size()))];
  }
  for (const int n : counts) {
    if (n != 1) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("sheared: along the axes nothing moves") {
  const auto base = MultiJitteredSampler().prepare({}, kPlan, nullptr);
  for (const double direction : {0.0, 90.0, -90.0, 180.0, -180.0}) {
    CHECK(test::points_of(*sheared(direction), {}, kLight, 64) ==
          test::points_of(*base, {}, kLight, 64));
  }
}

TEST_CASE("sheared: points are stratified across lines of the direction") {
  // At 45 degrees the points are stratified in y - x, at -45 degrees (135) in y + x.
  const auto base = MultiJitteredSampler().prepare({}, kPlan, nullptr);
  const auto points = test::points_of(*base, {.index = 3}, kLight, 64);
  CHECK_FALSE(is_stratified(points, -1, 1));
  CHECK(is_stratified(test::points_of(*sheared(45), {.index = 3}, kLight, 64), -1, 1));
  CHECK(is_stratified(test::points_of(*sheared(-45), {.index = 3}, kLight, 64), 1, 1));
  const double flat = 20, steep = 70, degree = 3.14159265358979323846 / 180;
  CHECK(test::fills_grid(test::points_of(*sheared(flat), {}, kLight, 64), 64, 1));
  CHECK(test::fills_grid(test::points_of(*sheared(steep), {}, kLight, 64), 1, 64));
  CHECK(
      is_stratified(test::points_of(*sheared(flat), {}, kLight, 64), -std::tan(flat * degree), 1));
  CHECK(is_stratified(test::points_of(*sheared(steep), {}, kLight, 64), 1,
                      -1 / std::tan(steep * degree)));
}

TEST_CASE("sheared: other purposes are left alone") {
  const auto base = MultiJitteredSampler().prepare({}, kPlan, nullptr);
  const auto sampler = sheared(30);
  CHECK(test::points_of(*sampler, {}, {Purpose::lens}, 64) ==
        test::points_of(*base, {}, {Purpose::lens}, 64));
  CHECK(test::numbers_of(*sampler, {}, kLight, 64) == test::numbers_of(*base, {}, kLight, 64));
}

TEST_CASE("sheared: points stay uniform") {
  std::vector<double> p_values;
  for (const double direction : {-70.0, -30.0, 17.0, 45.0, 100.0}) {
    const auto sampler = sheared(direction);
    for (const std::uint32_t sample : {0u, 5u}) {
      std::uint64_t pixel = 0;
      const auto draw = [&](RandomStream&) -> std::optional<Vec2> {
        return SampleStream(*sampler, {.index = pixel++, .sample = sample}).get_2d(kLight);
      };
      const auto fit = statistics::fit_square_density(draw, [](Vec2) { return 1.0; },
                                                      {.draws = 40'000, .cells = 100});
      CHECK(fit.is_density());
      p_values.push_back(fit.chi_square.p_value);
    }
  }
  for (const double p : statistics::holm_adjusted(p_values)) CHECK(p > 0.01);
}

TEST_CASE("toroidal_shift: all pixels have the same points, moved by one offset each") {
  const auto sampler = shifted();
  const auto first = test::points_of(*sampler, {}, kLight, 64);
  for (std::uint64_t pixel = 1; pixel < 20; ++pixel) {
    const auto points = test::points_of(*sampler, {.index = pixel}, kLight, 64);
    const double x = double{points[0].x} - first[0].x, y = double{points[0].y} - first[0].y;
    CHECK_FALSE((x == 0 && y == 0));
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK(fraction(double{points[i].x} - first[i].x - x) == 0);
      CHECK(fraction(double{points[i].y} - first[i].y - y) == 0);
    }
  }
}

TEST_CASE("toroidal_shift: numbers that are no multiples of 2^-24 never become one") {
  const auto number = [](float u, std::uint64_t pixel) {
    const auto sampler =
        ToroidalShiftSampler({.base = std::make_shared<FixedSampler>(u)}).prepare({}, {}, nullptr);
    return SampleStream(*sampler, {.index = pixel}).get_1d(kLight);
  };
  int small_offsets = 0;
  for (std::uint64_t pixel = 0; pixel < 4000; ++pixel) {
    const float by = number(0, pixel), back = 1 - by;
    for (const float u : {by, back}) {
      // Small floats are dense enough to represent the number just below the one that moves to 1.
      if (u >= 0x1p-7f || u == 0) continue;
      ++small_offsets;
      const float moved = number(u - 0x1p-30f, pixel);
      CHECK(moved >= 0);
      CHECK(moved < 1);
    }
  }
  CHECK(small_offsets > 20);
}

TEST_CASE("toroidal_shift: a shift of a shift moves twice, by different offsets") {
  // The base point is always zero, so the moved points are the offsets.
  const auto zero = std::make_shared<FixedSampler>(0.0f);
  const auto once =
      std::make_shared<ToroidalShiftSampler>(ToroidalShiftSampler::Settings{.base = zero});
  const auto inner = once->prepare({}, {}, nullptr);
  const auto both = ToroidalShiftSampler({.base = once}).prepare({}, {}, nullptr);
  const auto inner_part = [&](std::uint64_t pixel) {
    const Vec2 outer = SampleStream(*inner, {.index = pixel}).get_2d(kLight);
    const Vec2 sum = SampleStream(*both, {.index = pixel}).get_2d(kLight);
    return Vec2{static_cast<float>(fraction(double{sum.x} - outer.x)),
                static_cast<float>(fraction(double{sum.y} - outer.y))};
  };
  // The inner shift always uses the first pixel. It differs from the outer shift of every pixel.
  for (std::uint64_t pixel = 0; pixel < 20; ++pixel) {
    CHECK(inner_part(pixel) == inner_part(0));
    CHECK_FALSE(inner_part(pixel) == SampleStream(*inner, {.index = pixel}).get_2d(kLight));
  }
}

TEST_CASE("moved samplers: passes are those of the base") {
  const auto base =
      std::make_shared<MultiJitteredSampler>(MultiJitteredSampler::Settings{.samples = 9});
  CHECK(ShearedSampler({.base = base}).preferred_samples({}) == 9);
  CHECK(ToroidalShiftSampler({.base = base}).preferred_samples({}) == 9);
  CHECK_FALSE(ShearedSampler({.base = base}).needs_probe());
}

}  // namespace pharos
