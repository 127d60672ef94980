#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/image_agreement.h>

namespace pharos::statistics {
namespace {

/// Synthetic renders of a gradient. Each pixel is a sum of rare contributions of log-normal size.
struct Noise {
  int size = 32;
  int samples = 16;       ///< per pixel
  double hit_rate = 0.5;  ///< share of samples that contribute
  double spread = 0.5;    ///< standard deviation of the contributions' logarithm

  double contribution(RandomStream& random) const {
    if (random.next_1d() >= hit_rate) return 0;
    const double u = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
    return std::exp(spread * warp::normal_from_unit(u) - 0.5 * spread * spread) / hit_rate;
  }

  Image render(std::uint64_t seed, double scale = 1) const {
    RandomStream random(seed);
    Image image(size, size, {"R", "G", "B"});
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        double sum = 0;
        for (int i = 0; i < samples; ++i) sum += contribution(random);
        const double brightness = 1 + static_cast<double>(x) / size;
        const float value = static_cast<float>(scale * brightness * sum / samples);
        image.set_rgb(x, y, {0.5f * value, value, 1.5f * value});
      }
    }
    return image;
  }

  ImageSide side(std::uint64_t seed, double scale = 1, int renders = 32) const {
    std::vector<Image> all;
    for (int r = 0; r < renders; ++r) all.push_back(render(1000 * seed + r, scale));
    return ImageSide::of_renders(all, samples);
  }
};

}  // namespace

TEST_CASE("images agree: false alarms come at the nominal rate") {
  constexpr int kFamilies = 200;
  const Noise noise{.size = 16, .samples = 8};
  int alarms = 0;
  for (int family = 0; family < kFamilies; ++family) {
    const ImageAgreement result =
        compare_images(noise.side(2 * family), noise.side(2 * family + 1));
    alarms += !result.agree;
  }
  // The number of alarms is binomial with 1 %. More than seven alarms have a probability of 0.1 %.
  CHECK(alarms <= 7);
}

TEST_CASE("images agree: a scale of 1.03 is found, by a test that knows it can") {
  const Noise noise{.samples = 64};
  const ImageAgreement same = compare_images(noise.side(1), noise.side(2));
  INFO(same.summary());
  CHECK(same.proven());
  CHECK(same.regions.size() == 16);
  CHECK(same.whole_image.detectable_bias < 0.02);
  CHECK(same.whole_image.a.mean == doctest::Approx(1.484).epsilon(0.01));

  const ImageAgreement scaled = compare_images(noise.side(1), noise.side(3, 1.03));
  INFO(scaled.summary());
  CHECK_FALSE(scaled.agree);
  CHECK(scaled.valid);
}

TEST_CASE("images agree: a local fault is found") {
  const Noise noise{.samples = 64};
  std::vector<Image> renders;
  for (int r = 0; r < 32; ++r) {
    renders.push_back(noise.render(77000 + r));
    for (int y = 8; y < 16; ++y) {
      for (int x = 24; x < 32; ++x) renders.back().set_rgb(x, y, 1.1f * renders.back().rgb(x, y));
    }
  }
  const ImageAgreement result =
      compare_images(noise.side(1), ImageSide::of_renders(renders, noise.samples));
  CHECK_FALSE(result.agree);
  for (const RegionTest& test : result.regions) {
    const bool faulty = test.region.x0 == 24 && test.region.y0 == 8;
    CHECK((test.adjusted_p < 0.01) == faulty);
  }
}

TEST_CASE("images agree: heavy tails need large regions, and too few samples are admitted") {
  const Noise rare{.samples = 16, .hit_rate = 0.01, .spread = 1};
  const ImageSide a = rare.side(1), b = rare.side(2);
  // A block has about 64 * 16 * 0.01 / e contributions. They are far too few, so blocks are merged.
  CHECK(a.effective_contributions({0, 0, 8, 8}) == doctest::Approx(4).epsilon(0.6));
  const ImageAgreement result = compare_images(a, b);
  INFO(result.summary());
  CHECK(result.regions.size() == 1);
  CHECK(result.agree);
  CHECK_FALSE(result.valid);
}

TEST_CASE("images agree: effective contributions of equal ones are their number") {
  const Noise noise{.samples = 32, .hit_rate = 0.25, .spread = 0};
  const double expected = 16 * 16 * 32 * 0.25;
  CHECK(noise.side(5).effective_contributions({0, 0, 16, 16}) ==
        doctest::Approx(expected).epsilon(0.1));
}

TEST_CASE("images agree: a reference in two halves") {
  const Noise noise{.samples = 64}, fine{.samples = 4096};
  const ImageAgreement same =
      compare_images(noise.side(1), ImageSide::of_halves(fine.render(1), fine.render(2)));
  INFO(same.summary());
  CHECK(same.proven());
  const ImageAgreement scaled = compare_images(
      noise.side(1), ImageSide::of_halves(fine.render(1, 1.03), fine.render(2, 1.03)));
  CHECK_FALSE(scaled.agree);
}

TEST_CASE("images agree: both halves in one file") {
  const Image first = Noise{}.render(1), second = Noise{}.render(2);
  Image both(32, 32, {"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      both.set_rgb(x, y, first.rgb(x, y), 0);
      both.set_rgb(x, y, second.rgb(x, y), 3);
    }
  }
  const Region region{3, 5, 20, 31};
  const Estimate separate = ImageSide::of_halves(first, second).mean(region);
  const Estimate joint = ImageSide::of_halves(both).mean(region);
  CHECK(joint.mean == doctest::Approx(separate.mean));
  CHECK(joint.squared_error == doctest::Approx(separate.squared_error));
}

TEST_CASE("images agree: the error of halves is that of their mean") {
  const Noise noise{.samples = 16};
  double squared_error = 0;
  std::vector<double> means;
  for (int i = 0; i < 400; ++i) {
    const Estimate e =
        ImageSide::of_halves(noise.render(2 * i + 1), noise.render(2 * i + 2)).mean({0, 0, 8, 8});
    squared_error += e.squared_error / 400;
    means.push_back(e.mean);
  }
  CHECK(squared_error == doctest::Approx(moments(means).variance).epsilon(0.3));
}

TEST_CASE("images agree: what is black on both sides is not tested") {
  Noise noise{.samples = 64};
  const auto left_half = [&](std::uint64_t seed) {
    std::vector<Image> all;
    for (int r = 0; r < 32; ++r) {
      all.push_back(noise.render(1000 * seed + r));
      for (int y = 0; y < 32; ++y) {
        for (int x = 16; x < 32; ++x) all.back().set_rgb(x, y, Rgb(0));
      }
    }
    return ImageSide::of_renders(all, noise.samples);
  };
  const ImageAgreement result = compare_images(left_half(1), left_half(2));
  CHECK(result.regions.size() == 8);
  CHECK(result.proven());

  const std::vector<Image> black(2, Image(16, 16, {"R", "G", "B"}));
  const ImageSide dark = ImageSide::of_renders(black, 1);
  CHECK(compare_images(dark, dark).agree);
  CHECK_FALSE(compare_images(dark, dark).valid);
}

TEST_CASE("images agree: constant images agree up to rounding") {
  std::vector<Image> one(3, Image(8, 8, {"R", "G", "B"})), other = one, wrong = one;
  for (Image& image : one) image.values().assign(image.values().size(), 1.0f);
  for (Image& image : other) image.values().assign(image.values().size(), 1.0000001f);
  for (Image& image : wrong) image.values().assign(image.values().size(), 1.001f);
  const ImageSide a = ImageSide::of_renders(one, 64);
  CHECK(compare_images(a, ImageSide::of_renders(other, 64)).proven());
  CHECK_FALSE(compare_images(a, ImageSide::of_renders(wrong, 64)).agree);
}

TEST_CASE("images agree: bad input") {
  std::vector<Image> two(2, Image(8, 8, {"R", "G", "B"}));
  const ImageSide good = ImageSide::of_renders(two, 1);
  CHECK_THROWS_AS(ImageSide::of_renders(std::span(two).first(1), 1), InputError);
  CHECK_THROWS_AS(ImageSide::of_halves(two[0], Image(8, 4, {"R", "G", "B"})), InputError);
  CHECK_THROWS_AS(ImageSide::of_halves(two[0]), InputError);
  const std::vector<Image> larger(2, Image(16, 8, {"R", "G", "B"}));
  CHECK_THROWS_AS(compare_images(good, ImageSide::of_renders(larger, 1)), InputError);
  two[1].pixel(3, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_AS(ImageSide::of_renders(two, 1), InputError);
}

}  // namespace pharos::statistics
