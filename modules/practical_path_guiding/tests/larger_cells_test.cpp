#include "../larger_cells.h"

#include <sstream>

#include <doctest/doctest.h>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/tests/fixtures.h>

#include "../learner.h"
#include "../model.h"

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
  return with_larger_cells({&first, &other, &empty, &other}, row_of_cells(), prior, kRule);
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

TEST_CASE("the light of larger cells has the same share in the mean") {
  const std::vector<Sums> row = mixed_row(5);
  const double root = 70.0 / 400, half = 10.0 / 15 * 30.0 / 200 + 5.0 / 15 * root;
  CHECK(row[0].mean() == doctest::Approx(10.0 / 15 * 30.0 / 100 + 5.0 / 15 * half));
  CHECK(row[2].mean() == doctest::Approx(half));
}

TEST_CASE("no prior, no other cell's light; a large one, the same density everywhere") {
  const std::vector<Sums> apart = mixed_row(1e-9), alike = mixed_row(1e9);
  CHECK(share(apart[0], 0) == doctest::Approx(1));
  CHECK(share(apart[1], 0) == doctest::Approx(0));
  CHECK(apart[0].effective() == doctest::Approx(10));
  for (const Sums& sums : alike) CHECK(share(sums, 0) == doctest::Approx(30.0 / 70));
}

TEST_CASE("facings do not mix") {
  Cells cells = row_of_cells();
  cells.by_facing = true;
  const Sums lit = sums_of(10, 1, 2), dark = sums_of(0, 0, 0);
  std::vector<const Sums*> own(cells.count(), &dark);
  own[kFacings + 4] = &lit;  // cell 1, which faces up
  const std::vector<Sums> all = with_larger_cells(own, cells, 3, kRule);
  for (std::uint32_t i = 0; i < cells.count(); ++i) {
    CHECK((all[i].light > 0) == (i % kFacings == 4));
    if (i % kFacings == 4) CHECK(share(all[i], 2) == doctest::Approx(1));
  }
}

TEST_CASE("a dark scene stays dark") {
  const Sums dark = sums_of(0, 0, 0);
  for (const Sums& sums :
       with_larger_cells({&dark, &dark, &dark, &dark}, row_of_cells(), 3, kRule)) {
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
    log.begin_path({0.5f, 0.5f}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1), .local_weight = Rgb(1)});
    log.add(RecordedVertex{.position = {u.x, u.y, 0},
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(0.5f),
                           .direction = direction,
                           .pdf = 0.1f});
    log.add(RecordedVertex{.parent = 1, .emission = Rgb(is_lit ? 1.0f : 0.0f)});
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
