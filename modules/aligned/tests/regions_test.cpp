#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "../pixel_regions.h"
#include "probed_integrands.h"

namespace pharos::aligned {
namespace {

/// Returns the regions of a film for which only the first hits matter.
PixelRegions regions_of(PixelGrid grid, int edge, const SurfaceSettings& settings,
                        const test::FunctionProbe::Hits& hit_at) {
  const test::FunctionProbe probe(grid, {}, hit_at);
  return surface_regions(probe, edge, settings);
}

/// Checks that each pixel occurs exactly once, in its own region.
void check_partition(const PixelRegions& regions) {
  std::vector<int> counts(regions.pixel_count());
  for (std::size_t region = 0; region < regions.count(); ++region) {
    CHECK_FALSE(regions.pixels(region).empty());
    for (const std::uint32_t pixel : regions.pixels(region)) {
      ++counts[pixel];
      CHECK(regions.of(pixel) == region);
    }
  }
  for (const int n : counts) CHECK(n == 1);
}

}  // namespace

TEST_CASE("regions: any labels, numbered by their first pixels") {
  const std::vector<std::uint32_t> labels{7, 7, 2, 7, 900, 2};
  const PixelRegions regions(labels);
  CHECK(regions.count() == 3);
  CHECK(regions.of(0) == 0);
  CHECK(regions.of(5) == 1);
  CHECK(regions.of(4) == 2);
  CHECK(std::vector(regions.pixels(0).begin(), regions.pixels(0).end()) ==
        std::vector<std::uint32_t>{0, 1, 3});
  check_partition(regions);
  CHECK(PixelRegions().count() == 0);
}

TEST_CASE("regions: square blocks, cut at the borders") {
  const PixelRegions regions = block_regions({20, 10}, 8);
  CHECK(regions.count() == 6);
  check_partition(regions);
  CHECK(regions.pixels(0).size() == 64);
  CHECK(regions.pixels(2).size() == 32);
  CHECK(regions.pixels(5).size() == 8);
  CHECK(regions.of(9 * 20 + 19) == 5);
  CHECK(regions.of(7 * 20 + 8) == 1);
}

TEST_CASE("regions: one surface leaves blocks whole") {
  const auto wall = [](int x, int) { return FirstHit{1 + 0.01f * x, {0, 0, 1}, 3}; };
  const PixelRegions regions = regions_of({32, 32}, 16, {}, wall);
  CHECK(regions.count() == 4);
  const auto sky = [](int, int) { return FirstHit{}; };
  CHECK(regions_of({32, 32}, 16, {}, sky).count() == 4);
}

TEST_CASE("regions: blocks are divided by object, normal and depth") {
  const auto divided = [](const test::FunctionProbe::Hits& hit_at) {
    const PixelRegions regions = regions_of({16, 16}, 16, {}, hit_at);
    check_partition(regions);
    if (regions.count() == 2) CHECK(regions.of(0) != regions.of(15));
    return regions.count();
  };
  CHECK(divided([](int x, int) { return FirstHit{1, {0, 0, 1}, x < 8 ? 1u : 2u}; }) == 2);
  CHECK(divided([](int x, int) {
          return FirstHit{1, x < 8 ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, 1};
        }) == 2);
  CHECK(divided([](int x, int) { return FirstHit{x < 8 ? 1.0f : 2.0f, {0, 0, 1}, 1}; }) == 2);
  CHECK(divided([](int x, int) { return x < 8 ? FirstHit{} : FirstHit{1, {0, 0, 1}, 1}; }) == 2);
}

TEST_CASE("regions: few pixels join the same surface next door, or their block") {
  // The second object covers two columns of the left block and all of the right block.
  const auto two = [](int x, int) { return FirstHit{1, {0, 0, 1}, x < 14 ? 1u : 2u}; };
  const PixelRegions joined = regions_of({32, 16}, 16, {.fewest = 33}, two);
  CHECK(joined.count() == 2);
  CHECK(joined.of(14) == joined.of(20));
  CHECK(joined.of(13) != joined.of(14));
  CHECK(regions_of({32, 16}, 16, {.fewest = 32}, two).count() == 3);
  // A small object that no neighboring block sees.
  const auto dot = [](int x, int y) { return FirstHit{1, {0, 0, 1}, x == 5 && y == 5 ? 2u : 1u}; };
  CHECK(regions_of({32, 16}, 16, {}, dot).count() == 2);
  // The block contains only small objects and remains one region.
  const auto many = [](int x, int y) {
    return FirstHit{1, {0, 0, 1}, static_cast<std::uint32_t>(y * 16 + x)};
  };
  const PixelRegions one = regions_of({16, 16}, 16, {}, many);
  CHECK(one.count() == 1);
  check_partition(one);
}

}  // namespace pharos::aligned
