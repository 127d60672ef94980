#include <cmath>
#include <sstream>
#include <vector>

#include <doctest/doctest.h>

#include "grid_model.h"

namespace grid_guide {

using namespace pharos;

namespace {

/// A model of eight cells. Light comes from +y in the cell of the lowest corner, and there only.
GridModel lit_from_above() {
  std::vector<CellSums> sums(8);
  sums[0].radiance[bin_of({0, 1, 0})] = 3;
  sums[0].steps = 10;
  return GridModel({{{0, 0, 0}, {2, 2, 2}}, 2}, sums);
}

}  // namespace

TEST_CASE("grid: cells and bins") {
  const Grid grid{{{0, 0, 0}, {2, 2, 2}}, 2};
  CHECK(grid.cell_count() == 8);
  CHECK(grid.cell_of({0.5f, 0.5f, 0.5f}) == 0);
  CHECK(grid.cell_of({1.5f, 0.5f, 0.5f}) == 1);
  CHECK(grid.cell_of({0.5f, 0.5f, 1.5f}) == 4);
  CHECK(grid.cell_of({9, 9, 9}) == 7);  // outside
  CHECK(bin_of({0, -1, 0}) < kColumns);
  CHECK(bin_of({0, 1, 0}) >= kBins - kColumns);
}

TEST_CASE("grid: a cell knows what it has seen, and nothing else") {
  const GridModel model = lit_from_above();
  CHECK(model.place({.position = {0, 0, 0}}).evidence == 10);
  CHECK(model.place({.position = {2, 2, 2}}).evidence == 0);
  CHECK(model.place({.position = {2, 2, 2}}).region == 7);
}

TEST_CASE("grid: samples have the density that they state") {
  const GridModel model = lit_from_above();
  constexpr int kSamples = 1 << 17;
  std::vector<int> counts(kBins);
  std::vector<double> expected(kBins);
  for (int i = 0; i < kSamples; ++i) {
    const Vec2 u{(static_cast<float>(i) + 0.5f) / kSamples,
                 (static_cast<float>(i % 64) + 0.5f) / 64};
    const Vec3 direction = model.sample(0, u);
    CHECK(length(direction) == doctest::Approx(1));
    const std::uint32_t bin = bin_of(direction);
    ++counts[bin];
    expected[bin] = double{model.pdf(0, direction)} * (4 * kPi / kBins) * kSamples;
  }
  for (std::uint32_t bin = 0; bin < kBins; ++bin) {
    CAPTURE(bin);
    CHECK(counts[bin] > 0);
    CHECK(std::abs(counts[bin] - expected[bin]) < 2);
  }
}

TEST_CASE("grid: models are loaded as they were saved") {
  GridModel model = lit_from_above(), loaded;
  std::stringstream file;
  Archive out(static_cast<std::ostream&>(file));
  model.archive(out);
  Archive in(static_cast<std::istream&>(file));
  loaded.archive(in);
  CHECK(loaded.pdf(0, {0, 1, 0}) == model.pdf(0, {0, 1, 0}));
  CHECK(loaded.info().regions == 8);
}

}  // namespace grid_guide
