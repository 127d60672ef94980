#include "../splat.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include <pharos/core/warp.h>

#include "test_trees.h"

namespace pharos::focal {
namespace {

using namespace testing;

double total(const std::vector<double>& sums) {
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Computes the length of a line within the box between two distances by small steps.
double stepped_length(const Box& box, const Segment& s, double begin, double end) {
  constexpr int kSteps = 200'000;
  const double step = (end - begin) / kSteps;
  double inside = 0;
  for (int i = 0; i < kSteps; ++i) {
    const auto t = static_cast<float>(begin + (i + 0.5) * step);
    if (box.contains(s.origin + t * s.direction)) inside += step;
  }
  return inside;
}

Segment segment(Point3 from, Point3 to, bool whole_line) {
  return {.origin = from,
          .direction = normalize(to - from),
          .length = length(to - from),
          .contribution = 2.5f,
          .unguided_pdf = 0.4f,
          .unguided_share = 0.5f,
          .whole_line = whole_line};
}

/// A path of a lens vertex and two surface vertices. Three methods could have guided the step
/// between these, but the second one knew nothing.
struct TestPath {
  TestPath() {
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.throughput = Rgb(1)});
    log.add(RecordedVertex{.position = {0.2f, 1, 3},
                           .event = Event::smooth_reflect,
                           .guidable = true,
                           .parent = 0,
                           .throughput = Rgb(0.5f),
                           .local_weight = Rgb(0.8f),
                           .direction = {1, 0, 0}});
    log.set_techniques(1, std::array{Technique{0.25f, 0.7f}, Technique{0.5f, 2}, Technique{},
                                     Technique{0.25f, 5}});
    log.add(RecordedVertex{.position = {0.4f, 1, 3},
                           .roughness = 0.1f,
                           .parent = 1,
                           .throughput = Rgb(0.5f),
                           .emission = Rgb(3, 6, 9)});
  }

  RecordedVertex& operator[](std::uint32_t i) { return log.vertex(i); }

  std::vector<Segment> segments(SplatExtent extent = SplatExtent::line) const {
    std::vector<Segment> found;
    std::vector<Rgb> incident;
    extract_segments(log[0], {.extent = extent, .roughness = 0.3f}, incident, found);
    return found;
  }

  PathLog log;
};

}  // namespace

TEST_CASE("segments: the full-path contribution of guidable steps that found light") {
  TestPath path;
  const std::vector<Segment> found = path.segments();
  REQUIRE(found.size() == 1);
  CHECK(found[0].contribution == doctest::Approx(0.5 * 0.8 * 6));
  CHECK(found[0].origin == path[1].position);
  CHECK(found[0].length == doctest::Approx(0.2));
  CHECK(found[0].unguided_pdf == 0.7f);
  CHECK(found[0].guided_pdf == doctest::Approx((0.5 * 2 + 0.25 * 5) / 0.75));
  CHECK(found[0].unguided_share == 0.25f);
  CHECK(found[0].whole_line);
}

TEST_CASE("segments: densities are of directions, without the medium's factor") {
  TestPath path;
  path[1].medium_density = 0.25f;
  for (const VertexKind kind : {VertexKind::surface, VertexKind::volume}) {
    path[2].kind = kind;
    const std::vector<Segment> found = path.segments();
    REQUIRE(found.size() == 1);
    CHECK(found[0].unguided_pdf == doctest::Approx(4 * 0.7));
    CHECK(found[0].guided_pdf == doctest::Approx(4 * (0.5 * 2 + 0.25 * 5) / 0.75));
  }
}

TEST_CASE("segments: a step to a vertex that branches counts once") {
  TestPath path;
  RecordedVertex end = path[2];
  end.guidable = true;
  end.event = Event::smooth_reflect;
  end.local_weight = Rgb(1);
  path.log.add(end);  // the same vertex once more, for its second step
  const std::vector<Segment> found = path.segments();
  REQUIRE(found.size() == 1);
  CHECK(found[0].origin == path[1].position);
}

TEST_CASE("segments: what cannot be guided, found nothing or is not a number is left out") {
  const auto count = [](auto&& change) {
    TestPath path;
    change(path);
    return path.segments().size();
  };
  CHECK(count([](auto& v) { v[1].guidable = false; }) == 0);
  CHECK(count([](auto& v) { v[1].event = Event::discrete_reflect; }) == 0);
  CHECK(count([](auto& v) { v[2].emission = Rgb(); }) == 0);
  CHECK(count([](auto& v) { v[2].emission = Rgb(std::numeric_limits<float>::quiet_NaN()); }) == 0);
  CHECK(count([](auto& v) { v[2].emission = Rgb(std::numeric_limits<float>::infinity()); }) == 0);
  CHECK(count([](auto&) {}) == 1);
}

TEST_CASE("segments: with `roughness_gated` only nearly specular ends extend them") {
  TestPath path;
  CHECK(path.segments(SplatExtent::roughness_gated)[0].whole_line);
  path[2].roughness = 0.3f;
  CHECK(!path.segments(SplatExtent::roughness_gated)[0].whole_line);
  path[2].roughness = 0;
  path[2].kind = VertexKind::environment;
  const Segment escaped = path.segments(SplatExtent::roughness_gated)[0];
  CHECK(!escaped.whole_line);
  CHECK(escaped.length == kInfinity);
}

TEST_CASE("splat: lengths within the region, each sign its part of the line") {
  const FocalDensity density{random_tree(1), pinhole_tree()};
  const Box& box = density.converging.box();
  RandomStream random(1);
  for (int i = 0; i < 10; ++i) {
    const Point3 from = point_in_box(random, box), to = point_in_box(random, box);
    for (const bool whole_line : {false, true}) {
      const Segment s = segment(from, to, whole_line);
      FocalSums sums(density);
      splat_lengths({&s, 1}, density, 2.0, sums);
      const double ahead = whole_line ? stepped_length(box, s, 0, 10) : s.length;
      const double behind = whole_line ? stepped_length(box, s, -10, 0) : 0;
      CHECK(total(sums.converging) == doctest::Approx(2.5 * ahead / 2).epsilon(1e-3));
      CHECK(total(sums.diverging) == doctest::Approx(2.5 * behind / 2).epsilon(1e-3));
      FocalSums shares(density);
      splat_lengths({&s, 1}, density, 0, shares);
      CHECK(total(shares.converging) == doctest::Approx(2.5).epsilon(1e-6));
      CHECK(total(shares.diverging) == doctest::Approx(whole_line ? 2.5 : 0).epsilon(1e-6));
    }
  }
}

TEST_CASE("splat: lengths go to the cells that the line crosses") {
  const FocalDensity density{even_tree(), even_tree()};
  const Segment s = segment({0, 1, 2.5f}, {0.4f, 1.2f, 5}, false);
  FocalSums sums(density);
  splat_lengths({&s, 1}, density, 1, sums);
  // Computes the expected sums from points along the segment, cell by cell.
  std::vector<double> expected(sums.converging.size());
  constexpr int kSteps = 100'000;
  for (int i = 0; i < kSteps; ++i) {
    const Point3 p = s.origin + (static_cast<float>(i) + 0.5f) / kSteps * s.length * s.direction;
    Box cell = density.converging.box();
    std::uint32_t node = 0;
    for (;;) {
      unsigned c = 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        c |= static_cast<unsigned>(p[static_cast<int>(axis)] >=
                                   cell.low[axis] + 0.5 * cell.size[axis])
             << axis;
      }
      if (density.converging.nodes()[node].is_leaf(c)) {
        expected[8 * node + c] += 2.5 * s.length / kSteps;
        break;
      }
      node = density.converging.nodes()[node].index(c);
      cell = cell.child(c);
    }
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(sums.converging[i] == doctest::Approx(expected[i]).epsilon(1e-3).scale(s.length));
  }
}

TEST_CASE("splat: narrowing shares out what the guide would have sampled (eq. 14)") {
  const FocalDensity density = test_densities()[2].density;
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const Point3 from = point_in_box(random, test_box());
    const Segment s = segment(from, point_near(random, {0.1f, 1.3f, 3.7f}, 0.1f), true);
    const double guided = density.directional_density(s.origin, s.direction);
    FocalSums sums(density), alone(density);
    splat_narrowed({&s, 1}, density, true, sums);
    splat_narrowed({&s, 1}, density, false, alone);
    // A whole line meets all cells that could have sampled it. The weights sum to the guide's share
    // of the mixture, or to one without compensation.
    const double share = 0.5 * guided / (0.5 * 0.4 + 0.5 * guided);
    CHECK(sums.total() == doctest::Approx(2.5 * share).epsilon(1e-5));
    CHECK(alone.total() == doctest::Approx(2.5).epsilon(1e-5));
  }
}

TEST_CASE("splat: what other guides sample well is left to them") {
  const FocalDensity density = test_densities()[2].density;
  Segment s = segment({0, 1, 2.5f}, {0.1f, 1.3f, 3.7f}, true);
  const double own = density.directional_density(s.origin, s.direction);
  s.guided_pdf = static_cast<float>(10 * own);  // density of a mixture of guides
  FocalSums sums(density);
  splat_narrowed({&s, 1}, density, true, sums);
  CHECK(sums.total() == doctest::Approx(2.5 * 0.5 * own / (0.5 * 0.4 + 0.5 * 10 * own)));
}

TEST_CASE("splat: a segment that is splatted again counts as if this density had guided it") {
  const FocalDensity density = test_densities()[2].density;
  Segment s = segment({0, 1, 2.5f}, {0.1f, 1.3f, 3.7f}, true);
  const double own = density.directional_density(s.origin, s.direction);
  const auto first = [&] {
    FocalSums sums(density);
    splat_narrowed({&s, 1}, density, true, sums);
    return sums.total();
  };
  const auto again = [&](double least_share, bool mis_compensation = true) {
    FocalSums sums(density);
    splat_again({&s, 1}, density, mis_compensation, least_share, sums);
    return sums.total();
  };
  const auto expected = [&](double share, double guided) {
    return doctest::Approx(2.5 * share * own / ((1 - share) * 0.4 + share * guided));
  };
  s.unguided_share = 0.9f;
  s.guided_pdf = static_cast<float>(0.1 * own);
  CHECK(first() == expected(0.1, 0.1 * own));
  CHECK(again(0.5) == expected(0.5, own));
  CHECK(again(0.25) == expected(0.25, own));
  CHECK(again(0.5, false) == doctest::Approx(2.5));
  // Other guides that sample it better, and a larger share of the guides, stay as they were.
  s.unguided_share = 0.2f;
  s.guided_pdf = static_cast<float>(10 * own);
  CHECK(again(0.5) == expected(0.8, 10 * own));
  // No guide was asked.
  s.unguided_share = 1;
  s.guided_pdf = 0;
  CHECK(first() == 0);
  CHECK(again(0.5) == expected(0.5, own));
}

TEST_CASE("splat: the weight of one cell is its share of the density (eq. 12)") {
  LearningOctree two = uniform_octree(test_box(), 1);
  two.masses = {0.8, 0, 0, 0, 0, 0, 0, 0.2};
  const Octree octree = refined(two, {.threshold = 1, .max_depth = 0}).octree;
  const FocalDensity density{octree, Octree(test_box(), {Octree::Node{}})};
  // The segment crosses both cells along the diagonal from the low corner, so t^3 grows from 0 to 1
  // to 8.
  const Point3 low{-1.5f, 0.25f, 2}, high{1.5f, 2.25f, 6.5f};
  const Segment s = segment(low, high, true);
  FocalSums sums(density);
  splat_narrowed({&s, 1}, density, false, sums);
  CHECK(sums.converging[0] == doctest::Approx(2.5 * 0.8 / (0.8 + 0.2 * 7)));
  CHECK(sums.converging[7] == doctest::Approx(2.5 * 1.4 / (0.8 + 0.2 * 7)));
  // A segment that ends before the second cell adds nothing to this cell.
  const Segment half = segment(low, low + 0.4f * (high - low), false);
  FocalSums cut(density);
  splat_narrowed({&half, 1}, density, false, cut);
  CHECK(cut.converging[0] > 0);
  CHECK(cut.converging[7] == 0);
}

}  // namespace pharos::focal
