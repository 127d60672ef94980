#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <pharos/experiments/metrics/flip.h>

#include "direct_flip.h"
#include "test_images.h"

namespace pharos {
namespace {

using test::constant;

struct Disagreement {
  double largest = 0;
  double of_means = 0;
};

Disagreement disagreement(const std::vector<double>& a, const std::vector<double>& b) {
  Disagreement result;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result.largest = std::max(result.largest, std::abs(a[i] - b[i]));
    sum += a[i] - b[i];
  }
  result.of_means = std::abs(sum) / static_cast<double>(a.size());
  return result;
}

double first_error(const Image& image, const Image& reference) {
  return flip_errors(pair_pixels(image, reference)).front();
}

/// The tolerance for rounding in single precision; 5e-6 was observed.
constexpr double kRounding = 2e-5;

}  // namespace

TEST_CASE("FLIP agrees with the papers' formulas, pixel by pixel") {
  const Image reference = test::pattern(37, 29);
  for (const double noise : {0.02, 0.3, 1.0}) {
    for (const double degrees : {67.0, 30.0}) {
      CAPTURE(noise);
      CAPTURE(degrees);
      const PixelPair pair = pair_pixels(test::noisy(reference, noise), reference);
      const auto ours = flip_errors(pair, {degrees}), direct = test::direct_flip(pair, degrees);
      const Disagreement d = disagreement(ours, direct);
      CHECK(d.largest < kRounding);
      CHECK(d.of_means < 1e-6);
    }
  }
}

TEST_CASE("HDR-FLIP agrees with the papers' formulas, pixel by pixel") {
  const Image reference = test::pattern(26, 31, 14);
  const PixelPair pair = pair_pixels(test::noisy(reference, 0.5), reference);
  CHECK(exposure_range(pair.reference).count >= 6);
  const auto ours = hdr_flip_errors(pair), direct = test::direct_hdr_flip(pair, 67);
  const Disagreement d = disagreement(ours, direct);
  CHECK(d.largest < kRounding);
  CHECK(d.of_means < 1e-6);
}

TEST_CASE("FLIP of constant images in closed form") {
  // The distance of black and white is 100. The distance of green and blue is 203.45 after Hunt's
  // adjustment, and 41.2761 when raised to 0.7, as published implementations state.
  const double most = 41.2761, white = std::pow(100, 0.7);
  const double expected = 0.95 + 0.05 * (white - 0.4 * most) / (0.6 * most);
  CHECK(first_error(constant(30, 30, Rgb(1)), constant(30, 30, Rgb(0))) ==
        doctest::Approx(expected).epsilon(1e-4));
  CHECK(first_error(constant(30, 30, {0, 1, 0}), constant(30, 30, {0, 0, 1})) ==
        doctest::Approx(1).epsilon(1e-4));
  // Below the knee: grays of lightness 50 and 60 (CIE L*) have the distance ten.
  const auto gray = [](double lightness) {
    return Rgb(static_cast<float>(std::pow((lightness + 16) / 116, 3)));
  };
  CHECK(first_error(constant(30, 30, gray(50)), constant(30, 30, gray(60))) ==
        doctest::Approx(0.95 / (0.4 * most) * std::pow(10, 0.7)).epsilon(1e-3));
}

TEST_CASE("FLIP is symmetric, zero for equal images, and clips to what a display shows") {
  const Image a = test::pattern(40, 20), b = test::noisy(a, 0.4);
  const PixelPair forth = pair_pixels(a, b), back = pair_pixels(b, a), same = pair_pixels(a, a);
  CHECK(flip_errors(forth) == flip_errors(back));
  CHECK(std::ranges::all_of(flip_errors(same), [](double e) { return e == 0; }));
  CHECK(std::ranges::all_of(hdr_flip_errors(same), [](double e) { return e == 0; }));
  CHECK(first_error(constant(9, 9, Rgb(3)), constant(9, 9, Rgb(1))) == 0);
  CHECK(first_error(constant(9, 9, Rgb(-3)), constant(9, 9, Rgb(0))) == 0);
}

TEST_CASE("FLIP sees a single pixel, and less of it from further away") {
  Image reference = constant(41, 41, Rgb(0.2f)), image = reference;
  image.set_rgb(20, 20, Rgb(1));
  const PixelPair pair = pair_pixels(image, reference);
  const auto near = flip_errors(pair, {20}), far = flip_errors(pair, {120});
  const std::size_t hot = 20 * 41 + 20;
  CHECK(near[hot] > 0.5);
  CHECK(far[hot] < 0.5 * near[hot]);
  CHECK(near[0] < 1e-4);
}

TEST_CASE("HDR-FLIP does not depend on the exposure of both images") {
  const Image reference = test::pattern(30, 20, 8), image = test::noisy(reference, 0.3);
  const auto brighter = [](Image picture) {
    for (float& v : picture.values()) v *= 1024;  // exact
    return picture;
  };
  const auto errors = hdr_flip_errors(pair_pixels(image, reference));
  const auto scaled = hdr_flip_errors(pair_pixels(brighter(image), brighter(reference)));
  CHECK(disagreement(errors, scaled).largest < kRounding);
  CHECK(*std::max_element(errors.begin(), errors.end()) > 0.05);
}

TEST_CASE("exposures: from the brightest pixel to the median") {
  // Narkowicz' curve without its exposure maps 1.9996 to 0.85 of white.
  const auto shown = [](double x) {
    x *= 0.6;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  };
  const std::vector<Rgb> odd{Rgb(16), Rgb(1), Rgb(0)};
  const ExposureRange range = exposure_range(odd);
  CHECK(shown(16 * std::exp2(range.first)) == doctest::Approx(0.85).epsilon(1e-5));
  CHECK(shown(1 * std::exp2(range.last)) == doctest::Approx(0.85).epsilon(1e-5));
  CHECK(range.count == 4);
  CHECK(range.at(0) == range.first);
  CHECK(range.at(3) == doctest::Approx(range.last));
  const ExposureRange even = exposure_range(std::vector<Rgb>{Rgb(8), Rgb(1), Rgb(3), Rgb(0)});
  CHECK(even.last - even.first == doctest::Approx(2).epsilon(1e-5));  // the median is 2
}

TEST_CASE("exposures: dark references") {
  const ExposureRange mostly =
      exposure_range(std::vector<Rgb>{Rgb(4), Rgb(1), Rgb(0.5f), Rgb(0), Rgb(0), Rgb(0), Rgb(0)});
  CHECK(mostly.last - mostly.first ==
        doctest::Approx(2));  // log2 of 4 divided by the lit pixels' median of 1
  const ExposureRange black = exposure_range(std::vector<Rgb>{Rgb(0), Rgb(-1)});
  CHECK(black.first == 0);
  CHECK(black.last == 0);
  CHECK(black.count == 2);
  const ExposureRange wide = exposure_range(std::vector<Rgb>{Rgb(1e30f), Rgb(1e-30f), Rgb(1e-30f)});
  CHECK(wide.count == kMostExposures);
  CHECK(std::isfinite(wide.first));
  const ExposureRange flat = exposure_range(std::vector<Rgb>{Rgb(0.3f)});
  CHECK(flat.count == 2);
}

TEST_CASE("FLIP: pixels without a value do not spread") {
  const Image reference = test::pattern(30, 30);
  Image image = reference;
  image.set_rgb(15, 15, Rgb(std::numeric_limits<float>::quiet_NaN()));
  image.set_rgb(3, 4, {0, std::numeric_limits<float>::infinity(), 0});
  const PixelPair pair = pair_pixels(image, reference);
  CHECK(mean_over_pixels(flip_errors(pair), pair) == 0);
  CHECK(mean_over_pixels(hdr_flip_errors(pair), pair) == 0);
}

}  // namespace pharos
