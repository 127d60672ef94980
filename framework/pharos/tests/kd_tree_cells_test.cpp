#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/guiding/toolkit/guidable_steps.h>
#include <pharos/guiding/toolkit/kd_tree_cells.h>

namespace pharos {
namespace {

TEST_CASE("items are sorted by their keys and keep their order within") {
  std::vector<int> items{31, 12, 30, 11, 20, 10};
  const auto first = sort_by_key(
      items, 5, [&](std::size_t i) { return static_cast<std::uint32_t>(items[i] / 10); });
  CHECK(items == std::vector<int>{12, 11, 10, 20, 31, 30});
  CHECK(first == std::vector<std::size_t>{0, 0, 3, 4, 6, 6});
}

/// Returns a tree of four cells. The root is divided at x = 0, its upper part at y = 1, and the
/// upper part of this part at z = 2.
KdTree small_tree() {
  KdTree tree;
  auto halves = tree.divide(0, 0, 0);
  halves = tree.divide(halves.high, 1, 1);
  tree.divide(halves.high, 2, 2);
  return tree;
}

TEST_CASE("a kd-tree finds the cell around a point; edges belong to the upper one") {
  const KdTree tree = small_tree();
  CHECK(tree.cell_count() == 4);
  CHECK(tree.depth() == 3);
  CHECK(tree.cell_at({-1, 5, 5}) == 0);
  CHECK(tree.cell_at({0, 0, 5}) == 1);
  CHECK(tree.cell_at({1, 1, 1.9f}) == 2);
  CHECK(tree.cell_at({1, 1, 2}) == 3);
  const auto leaves = tree.leaves();
  const auto levels = tree.levels();
  CHECK(levels[leaves[0]] == 1);
  CHECK(levels[leaves[3]] == 3);
  const auto parents = tree.parents();
  REQUIRE(parents.size() == levels.size());
  for (std::size_t i = 1; i < parents.size(); ++i) {
    CHECK(parents[i] < i);
    CHECK(levels[parents[i]] == levels[i] - 1);
  }
}

TEST_CASE("the upper part of a kd-tree has the planes that are kept, and larger cells below them") {
  const KdTree tree = small_tree();
  const auto at_all = tree.upper_part(std::vector<bool>(7, true));
  CHECK(at_all.tree == tree);
  CHECK(at_all.places == tree.leaves());
  // The plane at z = 2, at place 4, is dropped.
  const auto upper = tree.upper_part({true, false, true, false, false, false, false});
  REQUIRE(upper.tree.cell_count() == 3);
  CHECK(upper.places == std::vector<std::uint32_t>{1, 3, 4});
  CHECK(upper.tree.cell_at({-1, 5, 5}) == 0);
  CHECK(upper.tree.cell_at({0, 0, 5}) == 1);
  CHECK(upper.tree.cell_at({1, 1, 1.9f}) == 2);
  CHECK(upper.tree.cell_at({1, 1, 2}) == 2);
  // Nothing is left below a plane that is dropped.
  CHECK(tree.upper_part({false, false, true, false, true, false, false}).tree == KdTree());
}

TEST_CASE("kd-trees survive being saved; damaged ones are refused or sound") {
  const auto loaded = [](const std::string& bytes) {
    std::istringstream in(bytes);
    KdTree tree;
    load(in, tree);
    return tree;
  };
  std::ostringstream out;
  save(out, small_tree());
  const std::string saved = out.str();
  CHECK(loaded(saved) == small_tree());
  RandomStream random(1);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string damaged = saved;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    if (i % 5 == 0) damaged.resize(random() % damaged.size());
    try {
      const KdTree tree = loaded(damaged);
      CHECK(tree.cell_at({0.5f, 1.5f, 2.5f}) < tree.cell_count());
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 100);
}

struct Step {
  Point3 origin;
};

/// Counts the steps from which it learns.
struct Counter {
  double seen = 0;
  bool knows = false;

  bool knows_something() const { return knows; }
  void forget(double factor) { seen *= factor; }
  void archive(Archive& archive) { archive(seen, knows); }
};
using Counters = KdTreeCells<Step, Counter>;

void count(Counter& counter, std::span<const Step> steps, std::size_t) {
  counter.seen += static_cast<double>(steps.size());
  counter.knows = counter.knows || !steps.empty();
}

/// Returns steps along x, from 0 to 1.
std::vector<Step> steps_along_x(int count) {
  std::vector<Step> steps;
  for (int i = 0; i < count; ++i) steps.push_back({{(i + 0.5f) / static_cast<float>(count), 0, 0}});
  return steps;
}

double total(const Counters& cells) {
  double sum = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) sum += cells[i].seen;
  return sum;
}

TEST_CASE("cells are divided where samples are many, and all samples count once") {
  Counters cells;
  const CellDivision rule{.cell_samples = 100, .max_depth = 32, .decay = 0.25};
  auto steps = steps_along_x(80);
  cells.learn(steps, rule, count);
  CHECK(steps.empty());
  CHECK(cells.size() == 1);
  CHECK(total(cells) == 80);
  steps = steps_along_x(80);
  cells.learn(steps, rule, count);
  CHECK(cells.size() == 2);
  // Both halves keep a quarter of the old count and learn from their own steps.
  CHECK(cells[0].seen == doctest::Approx(20 + 40));
  CHECK(cells[1].seen == doctest::Approx(20 + 40));
  CHECK(cells.tree().cell_at({0.49f, 0, 0}) != cells.tree().cell_at({0.51f, 0, 0}));
  CHECK(cells.origins() == std::vector<std::uint32_t>{0, 0});
  cells.mark_origins();
  CHECK(cells.origins() == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a first lesson that divides is learned once, by the halves") {
  Counters cells;
  auto steps = steps_along_x(1000);
  cells.learn(steps, {.cell_samples = 300, .decay = 0.25}, count);
  CHECK(cells.size() == 4);
  CHECK(total(cells) == 1000);
}

TEST_CASE("splatted steps teach neighbors, and each counts once, always the same") {
  const auto learned = [](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Counters cells;
    auto steps = steps_along_x(100);
    cells.learn(steps, {.cell_samples = 150}, count);
    steps = steps_along_x(100);
    cells.learn(steps, {.cell_samples = 150, .decay = 0}, count);
    REQUIRE(cells.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) cells[i].seen = 0;
    // All steps begin in the first half, evenly.
    steps = steps_along_x(20'000);
    steps.resize(10'000);
    cells.learn(steps, {.cell_samples = 1'000'000, .splats = true, .seed = 5}, count);
    return cells[cells.tree().cell_at({0.75f, 0, 0})].seen;
  };
  const double beyond = learned(1);
  // A step at a distance d from the plane leaves its half, of width w, with a probability of
  // 1/2 - d / w.
  CHECK(beyond == doctest::Approx(10'000 / 8.0).epsilon(0.1));
  CHECK(learned(2) == beyond);
  CHECK(learned(7) == beyond);
}

TEST_CASE("cells that know nothing, or lie at one place, or are deep enough, stay whole") {
  Counters silent;
  auto steps = steps_along_x(1000);
  silent.learn(steps, {.cell_samples = 100}, [](Counter&, std::span<const Step>, std::size_t) {});
  CHECK(silent.size() == 1);
  CHECK(!silent.know_something());
  Counters piled;
  steps.assign(1000, {{1, 2, 3}});
  piled.learn(steps, {.cell_samples = 100}, count);
  CHECK(piled.size() == 1);
  Counters flat;
  steps = steps_along_x(1000);
  flat.learn(steps, {.cell_samples = 10, .max_depth = 3}, count);
  CHECK(flat.size() == 8);
  Counters whole;
  steps = steps_along_x(1000);
  whole.learn(steps, {.divides = false, .cell_samples = 10}, count);
  CHECK(whole.size() == 1);
}

TEST_CASE("learning cells go on from where they were saved; cut ones are refused") {
  Counters cells;
  auto steps = steps_along_x(500);
  cells.learn(steps, {.cell_samples = 100}, count);
  std::ostringstream out;
  save(out, cells);
  std::istringstream in(out.str());
  Counters loaded;
  load(in, loaded);
  for (Counters* each : {&cells, &loaded}) {
    steps = steps_along_x(700);
    each->learn(steps, {.cell_samples = 100}, count);
  }
  CHECK(loaded.tree() == cells.tree());
  CHECK(total(loaded) == total(cells));
  std::istringstream cut(out.str().substr(0, out.str().size() / 2));
  CHECK_THROWS_AS(load(cut, loaded), InputError);
}

TEST_CASE("guidable steps: with what came along them, each once where paths branch") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.throughput = Rgb(1)});
  const RecordedVertex matt{.event = Event::smooth_reflect,
                            .guidable = true,
                            .parent = 0,
                            .local_weight = Rgb(0.5f),
                            .direction = {0, 0, 1},
                            .pdf = 0.25f};
  log.add(matt);
  // The next vertex is recorded twice, once for each step that it takes.
  for (int copy = 0; copy < 2; ++copy) {
    RecordedVertex next = matt;
    next.parent = 1;
    next.position = {0, 0, 1};
    const std::uint32_t index = log.add(next);
    log.add(RecordedVertex{.position = {0, 1, 1}, .parent = index, .emission = Rgb(4)});
  }
  RecordedVertex mirror = matt;
  mirror.event = Event::discrete_reflect;
  mirror.parent = 0;
  const std::uint32_t index = log.add(mirror);
  log.add(RecordedVertex{.parent = index, .emission = Rgb(9)});
  std::vector<std::uint32_t> numbers;
  std::vector<Rgb> incident;
  for_each_guidable_step(log[0], incident, [&](const GuidableStep& step) {
    numbers.push_back(step.number);
    CHECK(step.pdf == 0.25f);
    CHECK(step.radiance.r ==
          doctest::Approx(4));  // 2 x 0.5 x 4 at the first vertex, 4 at the copies
    CHECK(step.reflected.r == doctest::Approx(2));
  });
  CHECK(numbers == std::vector<std::uint32_t>{1, 2, 4});
}

TEST_CASE("guidable steps: the radiance makes up for Russian roulette, the density is the step's") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.throughput = Rgb(1)});
  log.add(RecordedVertex{.event = Event::smooth_reflect,
                         .guidable = true,
                         .parent = 0,
                         .local_weight = Rgb(2),
                         .direction = {0, 0, 1},
                         .pdf = 0.25f,
                         .continuation = 4});
  log.add(RecordedVertex{.position = {0, 0, 1}, .parent = 1, .emission = Rgb(3)});
  int count = 0;
  std::vector<Rgb> incident;
  for_each_guidable_step(log[0], incident, [&](const GuidableStep& step) {
    ++count;
    CHECK(step.pdf == 0.25f);
    CHECK(step.radiance.r == doctest::Approx(4 * 3));
    CHECK(step.reflected.r == doctest::Approx(2 * 3));
  });
  CHECK(count == 1);
}

}  // namespace
}  // namespace pharos
