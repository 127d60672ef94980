#include "../larger_cells.h"

#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../learner.h"
#include "../model.h"
#include "guided_paths.h"

namespace pharos::practical_path_guiding {
namespace {

constexpr QuadRefinement kRule{.threshold = 0.3};  // a tree of one node
constexpr Vec2 kQuarters[]{{0.2f, 0.2f}, {0.7f, 0.2f}, {0.2f, 0.7f}, {0.7f, 0.7f}};

/// Returns the sums of records of the same value, all in one quarter of the square.
Sums sums_of(int records, double value, int quarter) {
  Sums sums{.tree = QuadTree(kRule)};
  for (int i = 0; i < records; ++i) {
    sums.tree.add(kQuarters[quarter], value);
    sums.light += value;
    sums.squares += value * value;
  }
  sums.weight = sums.steps = 100;
  return sums;
}

/// Returns the share of a quarter in the density of a cell.
double share(const Sums& sums, unsigned quarter) {
  return sums.tree.density(LeafMass::sum)[0].share(quarter);
}

/// Four cells side by side: 0 to 3 along x.
Cells row_of_cells() {
  Cells cells;
  const KdTree::Halves halves = cells.space.divide(0, 0, 2);
  cells.space.divide(halves.low, 0, 1);
  cells.space.divide(halves.high, 0, 3);
  return cells;
}

/// Returns the row's sums, each together with larger cells. Cell 0 has ten records of value 3 in
/// quarter 0, its neighbor, number 2, has none, and the other two have 20 of value 1 in quarter 3.
std::vector<Sums> mixed_row(double prior) {
  const Sums first = sums_of(10, 3, 0), empty = sums_of(0, 0, 0), other = sums_of(20, 1, 3);
  return with_larger_cells({&first, &other, &empty, &other}, row_of_cells(), prior, LeafMass::sum,
                           kRule);
}

TEST_CASE("effective numbers of records are Kish's") {
  CHECK(sums_of(7, 3, 0).effective() == doctest::Approx(7));
  CHECK(sums_of(0, 0, 0).effective() == 0);
  Sums uneven = sums_of(10, 1, 0);
  uneven.light += 1000;
  uneven.squares += 1e6;
  CHECK(uneven.effective() == doctest::Approx(1010.0 * 1010.0 / 1000010.0));
}

TEST_CASE("larger cells have the share that their number of records says") {
  constexpr double kPrior = 5;
  REQUIRE(row_of_cells().at({0.5f, 0, 0}, 0u) == 0);
  REQUIRE(row_of_cells().at({1.5f, 0, 0}, 0u) == 2);
  const std::vector<Sums> row = mixed_row(kPrior);
  // The root has 30 in quarter 0 and 40 in quarter 3. Its lower half has ten records of quarter 0.
  const double root = 30.0 / 70;
  const double half = 10.0 / 15 + 5.0 / 15 * root;
  CHECK(share(row[0], 0) == doctest::Approx(10.0 / 15 + 5.0 / 15 * half));
  CHECK(share(row[2], 0) == doctest::Approx(half));
  // The upper half has 40 records, of which each of its cells has 20.
  const double upper = 5.0 / 45 * root;
  CHECK(share(row[1], 0) == doctest::Approx(5.0 / 25 * upper));
  for (const Sums& sums : row) {
    CHECK(sums.tree.total() == doctest::Approx(sums.light));
    CHECK(share(sums, 1) == 0);
    CHECK(share(sums, 2) == 0);
  }
}

TEST_CASE("records without light count for the mean") {
  const auto mixed = [](double own, double records, double larger) {
    return (own * records + larger * 5) / (records + 5);
  };
  const std::vector<Sums> row = mixed_row(5);
  const double half = mixed(30.0 / 200, 200, 70.0 / 400);
  CHECK(row[0].mean() == doctest::Approx(mixed(30.0 / 100, 100, half)));
  CHECK(row[2].mean() == doctest::Approx(mixed(0, 100, half)));

  Sums unvisited = sums_of(0, 0, 0);
  unvisited.weight = unvisited.steps = 0;
  const Sums lit = sums_of(10, 3, 0);
  const std::vector<Sums> cells =
      with_larger_cells({&lit, &lit, &unvisited, &lit}, row_of_cells(), 5, LeafMass::sum, kRule);
  CHECK(cells[2].mean() == doctest::Approx(0.3));
}

TEST_CASE(
    "a larger cell counts as many records as the prior, or as many as it has if these are fewer") {
  const std::vector<Sums> row = mixed_row(5);
  CHECK(row[0].effective() == doctest::Approx(10 + 5));
  CHECK(row[2].effective() == doctest::Approx(5));
  const double root = 70.0 * 70.0 / (10 * 9 + 40);  // fewer than the prior
  CHECK(mixed_row(1000)[0].effective() == doctest::Approx(10 + 10 + root));
}

TEST_CASE("without a prior, cells know their own light; with a large one, all know the same") {
  const std::vector<Sums> apart = mixed_row(1e-9), alike = mixed_row(1e9);
  CHECK(share(apart[0], 0) == doctest::Approx(1));
  CHECK(share(apart[1], 0) == doctest::Approx(0));
  for (const Sums& sums : alike) CHECK(share(sums, 0) == doctest::Approx(30.0 / 70));
}

TEST_CASE("larger cells are refined for what their densities follow from") {
  // One leaf has 95 % of the second moments, but a fifth of the density.
  const QuadRefinement fine{.max_depth = 4};
  Sums spiky{.tree = QuadTree(fine), .light = 100, .squares = 1, .weight = 100, .steps = 100};
  for (int i = 0; i < 256; ++i) {
    spiky.tree.add(
        {(static_cast<float>(i % 16) + 0.5f) / 16, (static_cast<float>(i / 16) + 0.5f) / 16},
        i == 0 ? 95 : 5.0 / 255);
  }
  const Sums dark{.tree = QuadTree({.threshold = 1})};
  const auto nodes = [&](LeafMass kind) {
    return with_larger_cells({&spiky, &dark, &dark, &dark}, row_of_cells(), 1, kind, fine)[1]
        .tree.node_count();
  };
  CHECK(nodes(LeafMass::root) > 2 * nodes(LeafMass::sum));
}

TEST_CASE("facings do not mix") {
  Cells cells = row_of_cells();
  cells.by_facing = true;
  const Sums lit = sums_of(10, 1, 2), dark = sums_of(0, 0, 0);
  std::vector<const Sums*> own(cells.count(), &dark);
  own[kFacings + 4] = &lit;  // cell 1, which faces up
  const std::vector<Sums> all = with_larger_cells(own, cells, 3, LeafMass::sum, kRule);
  for (std::uint32_t i = 0; i < cells.count(); ++i) {
    CHECK((all[i].light > 0) == (i % kFacings == 4));
    if (i % kFacings == 4) CHECK(share(all[i], 2) == doctest::Approx(1));
  }
}

TEST_CASE("a dark scene stays dark") {
  const Sums dark = sums_of(0, 0, 0);
  for (const Sums& sums :
       with_larger_cells({&dark, &dark, &dark, &dark}, row_of_cells(), 3, LeafMass::sum, kRule)) {
    CHECK(sums.light == 0);
    CHECK(sums.tree.total() == 0);
  }
}

/// Returns paths with one guidable step each, from random points of a floor to random directions.
/// One in `every` finds light, which lies straight above; none does if `every` is 0.
PathLog rarely_lit_paths(int count, int every, std::uint64_t seed) {
  PathLog log;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    const bool is_lit = every > 0 && i % every == 0;
    const Vec3 direction = is_lit ? Vec3{0, 0, 1} : warp::sphere_from_square(random.next_2d());
    add_step(log, {.position = {u.x, u.y, 0}, .direction = direction, .pdf = 0.1f},
             Rgb(is_lit ? 1.0f : 0.0f));
  }
  return log;
}

std::unique_ptr<LearningState> begin(const PracticalPathGuidingSettings& settings) {
  Bounds3 region;
  region.add(Point3{0, 0, 0});
  region.add(Point3{1, 1, 1});
  return PracticalPathGuidingLearner(settings).begin(
      {.region = region, .seed = 7, .window = {0, 0, 10, 10}});
}

/// Learns from paths without light, by which cells are divided, and then from five paths with light
/// among 20,000. Returns at how many of 400 places the guide knows something.
int known_places(const PracticalPathGuidingSettings& settings) {
  const auto state = begin(settings);
  state->absorb(rarely_lit_paths(20000, 0, 1));
  state->update({0, 1});
  state->absorb(rarely_lit_paths(20000, 4000, 2));
  const Learned learned = state->update({1, 0});
  int known = 0;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      const Point3 at{(static_cast<float>(x) + 0.5f) / 20, (static_cast<float>(y) + 0.5f) / 20, 0};
      known += learned.model->place({.position = at}).evidence > 0 ? 1 : 0;
    }
  }
  return known;
}

TEST_CASE("with larger cells, rare light is known everywhere") {
  CHECK(known_places({.spatial_threshold = 20}) < 200);
  CHECK(known_places({.spatial_threshold = 20, .spatial_prior = 2}) == 400);
}

/// Returns the density of the guide in a direction, after iterations of ten paths with light each.
double density_towards(Vec3 direction, PracticalPathGuidingSettings settings, int iterations) {
  settings.spatial_depth = 1;
  settings.directional_filter = DirectionalFilter::nearest;
  const auto state = begin(settings);
  Learned learned;
  for (int i = 0; i < iterations; ++i) {
    state->absorb(rarely_lit_paths(1000, 100, 3));
    learned = state->update({static_cast<std::uint32_t>(i), 1});
  }
  return learned.model->density({0.5f, 0.5f, 0}, &direction);
}

TEST_CASE("a prior of directions leaves density where no record is") {
  const Vec3 down{0, 0, -1}, near_up = normalize(Vec3{0.3f, 0.3f, 1}), up{0, 0, 1};
  CHECK(density_towards(down, {}, 1) == 0);
  const double even = 1 / (4 * 3.14159265);
  for (const double prior : {0.1, 1.0}) {
    const PracticalPathGuidingSettings settings{.directional_prior = prior};
    CHECK(density_towards(down, settings, 1) > 0);
    CHECK(density_towards(down, settings, 1) < even);
    CHECK(density_towards(near_up, settings, 1) > density_towards(down, settings, 1));
    CHECK(density_towards(up, settings, 1) < density_towards(up, {}, 1));
  }
  // Ten records of equal value: the prior has the share prior / 4 / (10 + prior) of each quarter.
  const PracticalPathGuidingSettings one_square{.directional_depth = 1, .directional_prior = 2};
  CHECK(density_towards(down, one_square, 1) == doctest::Approx(4 * even * 0.5 / 12));
}

TEST_CASE("priors are not remembered as records") {
  // With all iterations remembered, ten times as many records leave a tenth of the prior's share.
  const PracticalPathGuidingSettings settings{
      .directional_depth = 1, .memory = 1, .spatial_prior = 3, .directional_prior = 2};
  const Vec3 down{0, 0, -1};
  const double even = 1 / (4 * 3.14159265);
  // Both halves of the scene have all records in common with the whole, so only their number
  // counts.
  CHECK(density_towards(down, settings, 10) < 4 * even * 0.5 / (10 * 5 + 3));
  CHECK(density_towards(down, settings, 10) > 4 * even * 0.5 / (10 * 10 + 10));
}

TEST_CASE("learning with priors goes on from a file, with a memory and by facing, too") {
  for (const bool by_facing : {false, true}) {
    const PracticalPathGuidingSettings settings{.spatial_threshold = 50,
                                                .by_facing = by_facing,
                                                .memory = 0.5,
                                                .spatial_prior = 2,
                                                .directional_prior = 0.1};
    const auto whole = begin(settings), resumed = begin(settings);
    whole->absorb(rarely_lit_paths(3000, 10, 1));
    whole->update({0, 2});
    whole->absorb(rarely_lit_paths(3000, 10, 2));
    std::stringstream file(test::saved(*whole));
    load(file, *resumed);
    for (const auto& state : {whole.get(), resumed.get()})
      state->absorb(rarely_lit_paths(99, 3, 3));
    CHECK(test::saved(*whole->update({1, 1}).model) == test::saved(*resumed->update({1, 1}).model));
  }
}

}  // namespace
}  // namespace pharos::practical_path_guiding
