#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/core/error.h>
#include <pharos/core/ray.h>
#include <pharos/experiments/metrics/metrics.h>

#include "test_images.h"

namespace pharos {
namespace {

using test::constant;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double one(Metric metric, const Image& image, const Image& reference) {
  return measure(image, reference, std::vector{metric})[metric];
}

Image scaled(Image image, float factor) {
  for (float& v : image.values()) v *= factor;
  return image;
}

/// Returns the message of the InputError that `measure` throws.
std::string refusal(const Image& image, const Image& reference) {
  try {
    measure(image, reference);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Returns the mean of the pixels that are not NaN.
double mean_of(const Image& map) {
  double sum = 0, count = 0;
  for (const float v : map.values()) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  return sum / count;
}

}  // namespace

TEST_CASE("metrics: the table is in the order of the enum and complete") {
  std::set<std::string_view> keys, titles;
  for (std::size_t i = 0; i < kMetricCount; ++i) {
    const MetricInfo& info = metric_infos()[i];
    CHECK(static_cast<std::size_t>(info.metric) == i);
    CHECK(&metric_info(info.metric) == &info);
    keys.insert(info.key);
    titles.insert(info.title);
    CHECK_FALSE(info.definition.empty());
    CHECK_FALSE(info.source.empty());
  }
  CHECK(keys.size() == kMetricCount);
  CHECK(titles.size() == kMetricCount);
}

TEST_CASE("metrics: a constant offset in closed form") {
  const Image image = constant(7, 5, {0.5f, 0.25f, 1.0f}), reference = constant(7, 5, Rgb(0.5f));
  const double mse = (0.0625 + 0.25) / 3;
  const ImageErrors errors = measure(image, reference);
  CHECK(errors[Metric::mse] == doctest::Approx(mse));
  CHECK(errors[Metric::capped_mse] == doctest::Approx(mse));
  CHECK(errors[Metric::relative_mse] == doctest::Approx(mse / (0.25 * 1.01)));
  CHECK(errors[Metric::trimmed_relative_mse] == doctest::Approx(mse / (0.25 * 1.01)));
  CHECK(errors[Metric::floored_relative_mse] == doctest::Approx(mse / 0.26));
  CHECK(errors[Metric::mape] == doctest::Approx(0.75 / 3 / 0.51));
  CHECK(errors[Metric::smape] == doctest::Approx((0.25 / 0.385 + 0.5 / 0.76) / 3));
  CHECK(errors[Metric::psnr] == doctest::Approx(-10 * std::log10(mse)));
  CHECK(errors.invalid_pixels == 0);
}

TEST_CASE("metrics: equal images") {
  const Image image = test::pattern(33, 21);
  const ImageErrors errors = measure(image, image);
  for (const MetricInfo& info : metric_infos()) {
    CAPTURE(info.key);
    if (info.metric == Metric::psnr) {
      CHECK(errors[info.metric] == std::numeric_limits<double>::infinity());
    } else {
      CHECK(errors[info.metric] == 0);
    }
  }
}

TEST_CASE("metrics: only what was asked for") {
  const ImageErrors errors = measure(constant(4, 4, Rgb(1)), constant(4, 4, Rgb(0)),
                                     std::vector{Metric::mse, Metric::psnr});
  CHECK(errors[Metric::mse] == 1);
  CHECK(errors[Metric::psnr] == 0);
  CHECK(std::isnan(errors[Metric::flip]));
  CHECK(std::isnan(errors[Metric::relative_mse]));
}

TEST_CASE("capped MSE: one hot pixel in a thousand counts like its neighbors") {
  const Image reference = constant(50, 20, Rgb(0));
  Image image = constant(50, 20, Rgb(0.5f));
  image.set_rgb(13, 7, Rgb(1000));
  CHECK(one(Metric::capped_mse, image, reference) == doctest::Approx(0.25));
  CHECK(one(Metric::mse, image, reference) == doctest::Approx((999 * 0.25 + 1e6) / 1000));
  // With two hot pixels, the error of the weaker one is the cap.
  image.set_rgb(14, 7, Rgb(2));
  CHECK(one(Metric::capped_mse, image, reference) == doctest::Approx((998 * 0.25 + 2 * 4) / 1000));
}

TEST_CASE("capped MSE: known quantiles") {
  // The errors are 0, 1, 4, …, 1999^2. The rank of 99.9 % is 1998, so the last two errors are
  // capped.
  const Image reference = constant(100, 20, Rgb(0));
  Image image = reference;
  double sum = 2 * 1997.0 * 1997.0;
  for (int i = 0; i < 2000; ++i) {
    image.set_rgb(i * 7 % 100, i / 100, Rgb(static_cast<float>(i)));
    if (i < 1998) sum += static_cast<double>(i) * i;
  }
  CHECK(one(Metric::capped_mse, image, reference) == doctest::Approx(sum / 2000));
  // With fewer than a thousand pixels, no pixel is capped.
  const Image few = test::noisy(constant(9, 111, Rgb(1)), 0.5), flat = constant(9, 111, Rgb(1));
  CHECK(one(Metric::capped_mse, few, flat) == one(Metric::mse, few, flat));
}

TEST_CASE("trimmed relMSE: the worst pixel in a thousand does not count") {
  const Image reference = constant(50, 40, Rgb(1));
  Image image = constant(50, 40, Rgb(1.5f));
  image.set_rgb(13, 7, Rgb(1000));
  image.set_rgb(3, 9, Rgb(-20));
  CHECK(one(Metric::trimmed_relative_mse, image, reference) == doctest::Approx(0.25 / 1.01));
  const Image map = error_map(Metric::trimmed_relative_mse, image, reference);
  CHECK(std::isnan(*map.pixel(13, 7)));
  CHECK(std::isnan(*map.pixel(3, 9)));
  // A third outlier counts.
  image.set_rgb(30, 30, Rgb(11));
  CHECK(one(Metric::trimmed_relative_mse, image, reference) ==
        doctest::Approx((1997 * 0.25 + 100) / 1.01 / 1998));
  // Of a thousand equal errors, one is left out, and the mean stays.
  CHECK(one(Metric::trimmed_relative_mse, constant(50, 20, Rgb(1.5f)), constant(50, 20, Rgb(1))) ==
        doctest::Approx(0.25 / 1.01));
  // With fewer than a thousand pixels, no pixel is left out.
  const Image few = test::noisy(constant(9, 111, Rgb(1)), 0.5), flat = constant(9, 111, Rgb(1));
  CHECK(one(Metric::trimmed_relative_mse, few, flat) == one(Metric::relative_mse, few, flat));
}

TEST_CASE("relMSE: epsilon is 1 % of the reference's mean squared luminance") {
  // The left half of the reference is black.
  Image reference = constant(20, 10, Rgb(0)), image = constant(20, 10, Rgb(0.1f));
  for (int y = 0; y < 10; ++y) {
    for (int x = 10; x < 20; ++x) {
      reference.set_rgb(x, y, {0, 2, 0});
      image.set_rgb(x, y, {0, 2, 0});
    }
  }
  const double luminance = 2 * 0.7152, epsilon = 0.01 * luminance * luminance / 2;
  CHECK(one(Metric::relative_mse, image, reference) ==
        doctest::Approx(0.5 * 0.01 / epsilon).epsilon(1e-4));
  // A black reference is infinitely far from everything else, but not from itself.
  const Image black = constant(5, 5, Rgb(0));
  CHECK(one(Metric::relative_mse, black, black) == 0);
  CHECK(one(Metric::relative_mse, constant(5, 5, Rgb(1)), black) == kInfinity);
}

TEST_CASE("relMSE does not depend on the unit of radiance") {
  const Image reference = test::pattern(40, 50), image = test::noisy(reference, 0.4);
  for (const Metric metric : {Metric::relative_mse, Metric::trimmed_relative_mse}) {
    CAPTURE(metric_info(metric).key);
    const double expected = one(metric, image, reference);
    for (const float scale : {1.0f / 4096, 1024.0f}) {
      CHECK(one(metric, scaled(image, scale), scaled(reference, scale)) ==
            doctest::Approx(expected).epsilon(1e-5));
    }
  }
}

TEST_CASE("metrics: PSNR and FLIP see images at their exposure") {
  const Image reference = test::pattern(40, 30), image = test::noisy(reference, 0.4);
  const Image dark_reference = scaled(reference, 1.0f / 64), dark = scaled(image, 1.0f / 64);
  const ImageErrors expected = measure(image, reference);
  const ImageErrors unexposed = measure(dark, dark_reference);
  const ImageErrors exposed = measure(dark, dark_reference, {.exposure = 6});
  for (const Metric metric : {Metric::psnr, Metric::flip}) {
    CAPTURE(metric_info(metric).key);
    CHECK(exposed[metric] == doctest::Approx(expected[metric]).epsilon(1e-5));
    CHECK(std::abs(unexposed[metric] / expected[metric] - 1) > 0.2);
    const double mean = mean_of(error_map(metric, dark, dark_reference, {.exposure = 6}));
    CHECK((metric == Metric::psnr ? -10 * std::log10(mean) : mean) ==
          doctest::Approx(expected[metric]).epsilon(1e-5));
  }
  for (const MetricInfo& info : metric_infos()) {
    if (info.metric == Metric::psnr || info.metric == Metric::flip) continue;
    CAPTURE(info.key);
    CHECK(exposed[info.metric] == unexposed[info.metric]);
  }
}

TEST_CASE("metrics: brighter images") {
  const Image reference = test::pattern(30, 30), image = test::noisy(reference, 0.2);
  const Image bright_reference = scaled(reference, 16), bright = scaled(image, 16);
  for (const Metric metric : {Metric::mse, Metric::capped_mse}) {
    CHECK(one(metric, bright, bright_reference) ==
          doctest::Approx(256 * one(metric, image, reference)));
  }
  // Relative errors stay the same except for the floor, which hides less in brighter images.
  for (const Metric metric : {Metric::floored_relative_mse, Metric::mape, Metric::smape}) {
    const double before = one(metric, scaled(image, 100), scaled(reference, 100));
    const double after = one(metric, scaled(bright, 100), scaled(bright_reference, 100));
    CHECK(after > before);
    CHECK(after == doctest::Approx(before).epsilon(0.02));
    CHECK(after > 1.1 * one(metric, image, reference));
  }
  CHECK(one(Metric::floored_relative_mse, constant(3, 3, Rgb(2e4f)), constant(3, 3, Rgb(1e4f))) ==
        doctest::Approx(1));
}

TEST_CASE("metrics: symmetric ones and others") {
  const Image a = test::pattern(30, 20), b = test::noisy(a, 0.6);
  for (const Metric metric :
       {Metric::mse, Metric::capped_mse, Metric::smape, Metric::psnr, Metric::flip}) {
    CAPTURE(metric_info(metric).key);
    CHECK(one(metric, a, b) == one(metric, b, a));
  }
  CHECK(one(Metric::relative_mse, a, b) != one(Metric::relative_mse, b, a));
  CHECK(one(Metric::mape, a, b) != one(Metric::mape, b, a));
}

TEST_CASE("SMAPE is below two") {
  CHECK(one(Metric::smape, constant(3, 3, Rgb(1e9f)), constant(3, 3, Rgb(0))) ==
        doctest::Approx(2));
}

TEST_CASE("PSNR does not see what a display clips") {
  CHECK(one(Metric::psnr, constant(3, 3, Rgb(7)), constant(3, 3, Rgb(1))) ==
        std::numeric_limits<double>::infinity());
  CHECK(one(Metric::psnr, constant(3, 3, Rgb(0.9f)), constant(3, 3, Rgb(5))) ==
        doctest::Approx(20));
}

TEST_CASE("metrics: errors too large for single precision are still numbers") {
  CHECK(one(Metric::mse, constant(3, 3, Rgb(1e30f)), constant(3, 3, Rgb(0))) ==
        doctest::Approx(1e60));
}

TEST_CASE("metrics: pixels without a value are left out and counted") {
  Image reference = constant(40, 30, Rgb(0.5f)), image = constant(40, 30, Rgb(0.75f));
  const ImageErrors clean = measure(image, reference);
  image.set_rgb(3, 3, {kNan, 1, 1});
  image.set_rgb(4, 3, {1, 1, kInfinity});
  reference.set_rgb(4, 3, Rgb(kNan));  // the same pixel counts only once
  reference.set_rgb(20, 9, {1, -kInfinity, 1});
  const ImageErrors errors = measure(image, reference);
  CHECK(errors.invalid_pixels == 3);
  for (const MetricInfo& info : metric_infos()) {
    if (info.metric == Metric::flip || info.metric == Metric::hdr_flip) continue;
    CAPTURE(info.key);
    CHECK(errors[info.metric] == doctest::Approx(clean[info.metric]));
  }
  CHECK(std::isfinite(errors[Metric::hdr_flip]));
  const Image map = error_map(Metric::mse, image, reference);
  CHECK(std::isnan(*map.pixel(3, 3)));
  CHECK(std::isnan(*map.pixel(20, 9)));
  CHECK(*map.pixel(0, 0) == 0.0625f);
}

TEST_CASE("error maps: their mean is the metric") {
  const Image reference = test::pattern(50, 40), image = test::noisy(reference, 0.5);
  for (const MetricInfo& info : metric_infos()) {
    CAPTURE(info.key);
    const Image map = error_map(info.metric, image, reference);
    CHECK(map.channels() == std::vector<std::string>{"Y"});
    CHECK(map.width() == 50);
    const double mean = mean_of(map);
    const double value = info.metric == Metric::psnr ? -10 * std::log10(mean) : mean;
    CHECK(one(info.metric, image, reference) == doctest::Approx(value).epsilon(1e-6));
    CHECK(*std::max_element(map.values().begin(), map.values().end()) > 0);
  }
}

TEST_CASE("metrics: the same bits for any number of threads") {
  const Image reference = test::pattern(131, 97, 6), image = test::noisy(reference, 0.7);
  const auto with = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ImageErrors errors;
    tbb::task_arena(threads).execute([&] { errors = measure(image, reference); });
    return errors.values;
  };
  const auto alone = with(1);
  CHECK(alone == with(2));
  CHECK(alone == with(3));
}

TEST_CASE("metrics: channels are found by name") {
  const Image reference = constant(4, 3, {1, 2, 3});
  Image image(4, 3, {"B", "depth.Z", "G", "R"});
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x)
      std::ranges::copy(std::array{3.f, 99.f, 2.f, 1.f}, image.pixel(x, y));
  }
  CHECK(measure(image, reference)[Metric::mse] == 0);
}

TEST_CASE("metrics: images that cannot be compared") {
  const Image reference = constant(4, 3, Rgb(1));
  CHECK(refusal(constant(3, 4, Rgb(1)), reference) ==
        "the image: error: expected the size of the reference, 4 x 3 pixels, found 3 x 4");
  CHECK(refusal(Image(4, 3, {"Y"}), reference) ==
        "the image: error: expected channels R, G and B, found 'Y'");
  CHECK(refusal(reference, Image(4, 3, {"R", "G"})) ==
        "the reference: error: expected channels R, G and B, found 'R', 'G'");
  CHECK(refusal(constant(4, 3, Rgb(kNan)), reference) ==
        "the image: error: no pixel is finite both here and in the reference");
  CHECK(refusal(constant(4, 3, Rgb(1)), constant(4, 3, Rgb(kInfinity))) != "");
  CHECK_THROWS_AS(error_map(Metric::mse, constant(3, 4, Rgb(1)), reference), InputError);
}

}  // namespace pharos
