#include <algorithm>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/experiments/pictures/color_map.h>
#include <pharos/experiments/pictures/point_pictures.h>
#include <pharos/experiments/pictures/sampled_points.h>

namespace pharos {
namespace {

bool is_dark(const Image& image, int x, int y) {
  return luminance(image.rgb(x, y)) < 0.3f;
}

/// A sampler that places each sample on a lattice, so that the point encodes the request. It
/// records the settings of its preparations.
class TellingSampler final : public Sampler {
 public:
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe*) const override {
    CHECK(grid.width > 0);
    seeds.push_back(plan.seed);
    samples.push_back(plan.samples_per_pixel);
    return std::make_unique<Prepared>();
  }
  mutable std::vector<std::uint64_t> seeds;
  mutable std::vector<std::uint32_t> samples;

 private:
  class Prepared final : public PreparedSampler {
   public:
    std::uint64_t begin(const PathKey&) const override { return 0; }
    float value_1d(const SampleStream&, Dimension) const override { return 0; }
    Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
      return {static_cast<float>(stream.key().sample) / 16 +
                  static_cast<float>(stream.key().seed) / 1024,
              static_cast<float>(dimension.bounce()) / 16};
    }
  };
};

}  // namespace

TEST_CASE("picture of points: x to the right, y up, paper between them") {
  const std::vector<Vec2> points{{0.25f, 0.1f}, {0.75f, 0.9f}};
  const Image image = points_picture(points, 100);
  CHECK(image.width() == 100);
  CHECK(image.height() == 100);
  CHECK(is_dark(image, 25, 90));
  CHECK(is_dark(image, 75, 10));
  CHECK(image.rgb(25, 10) == Rgb(1));
  CHECK(image.rgb(75, 90) == Rgb(1));
  CHECK(image.rgb(50, 50) == Rgb(1));
  // A point in the corner is cut off at the border.
  CHECK(is_dark(points_picture(std::vector<Vec2>{{0, 0}}, 50), 0, 49));
}

TEST_CASE("picture of a spectrum: frequencies lie where they belong") {
  // The points repeat along (1, -1), so all power is at multiples of (1, 1), the dual lattice of i
  // (1/4, -1/4).
  statistics::PowerSpectrum spectrum(2);
  spectrum.add(std::vector<Vec2>{{0, 0}, {0.25f, 0.75f}, {0.5f, 0.5f}, {0.75f, 0.25f}});
  const Image image = spectrum_picture(spectrum, 50);
  const auto at = [&](int x, int y) { return image.rgb(25 + 10 * x, 25 - 10 * y); };
  const ColorScale scale{kLowestPower, kHighestPower, true};
  const float bright = luminance(magma(scale_position(4, scale)));
  CHECK(luminance(at(1, 1)) == doctest::Approx(bright));
  CHECK(luminance(at(-1, -1)) == doctest::Approx(bright));
  CHECK(luminance(at(2, 2)) == doctest::Approx(bright));
  CHECK(at(1, -1) == magma(0));
  CHECK(at(-1, 1) == magma(0));
  CHECK(at(0, 0) == magma(0));
  CHECK(image.rgb(30, 19) == at(1, 1));
  CHECK(image.rgb(39, 10) == at(1, 1));
  CHECK(image.rgb(40, 10) == at(2, 1));
}

TEST_CASE("contact sheet: row by row, white where there is nothing") {
  std::vector<Image> pictures(3, Image(4, 2, {"R", "G", "B"}));
  for (std::size_t i = 0; i < 3; ++i) {
    std::ranges::fill(pictures[i].values(), 0.1f * static_cast<float>(i));
  }
  const Image sheet = contact_sheet(pictures, 2);
  const int right = sheet.width() - 4, low = sheet.height() - 2;
  CHECK(right > 4);
  CHECK(low > 2);
  CHECK(sheet.rgb(3, 1) == Rgb(0));
  CHECK(sheet.rgb(right, 1) == Rgb(0.1f));
  CHECK(sheet.rgb(0, low) == Rgb(0.2f));
  CHECK(sheet.rgb(right, low) == Rgb(1));
  CHECK(sheet.rgb(4, 0) == Rgb(1));
  pictures[1] = {};
  CHECK(contact_sheet(pictures, 2).rgb(right, 1) == Rgb(1));
  CHECK(contact_sheet({}, 2).empty());
}

TEST_CASE("sampled points: one pixel's samples in a dimension, a seed a realization") {
  const TellingSampler sampler;
  const std::vector<Vec2> points = sampled_points(sampler, {Purpose::lens, 3}, 5, 2);
  CHECK(points.size() == 5);
  CHECK(points[4] == Vec2{4.0f / 16 + 2.0f / 1024, 3.0f / 16});
  CHECK(sampler.samples == std::vector<std::uint32_t>{5});
  const auto spectrum = expected_spectrum(sampler, {{Purpose::pixel}, 16, 3, 17});
  CHECK(spectrum.count() == 3);
  CHECK(sampler.seeds == std::vector<std::uint64_t>{2, 0, 1, 2});
  // Sixteen points in a row are in phase at (16, 0), and in phase at all frequencies along y.
  CHECK(spectrum.at(16, 5) == doctest::Approx(16));
  CHECK(spectrum.at(8, 0) == doctest::Approx(0));
}

}  // namespace pharos
