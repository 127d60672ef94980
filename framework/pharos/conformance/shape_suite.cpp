#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/stage.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

/// A shape alone in a scene, with a sphere around it.
struct Stand {
  explicit Stand(const Ref<Shape>& s) : shape(*s), scene(alone(s)) {
    center = s->bounds().center();
    radius = 0.51f * s->bounds().diagonal();
  }

  const Shape& shape;
  Scene scene;
  Point3 center;
  float radius;
};

std::string text(Point3 p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

/// Returns a line of the uniform and isotropic measure through the sphere around the shape.
Ray random_line(const Stand& stand, RandomStream& random) {
  const Vec3 direction = normalize(warp::sphere_from_square(random.next_2d()));
  const Vec2 disk = warp::disk_from_square(random.next_2d());
  const Frame frame = Frame::from_normal(direction);
  const Vec3 foot = stand.radius * (disk.x * frame.s + disk.y * frame.t - 1.01f * direction);
  return {stand.center + foot, direction};
}

std::vector<SurfacePoint> hits_of(const Stand& stand, const Ray& ray) {
  std::vector<SurfacePoint> hits;
  sum_along(stand.scene, ray, [&](const SurfacePoint& p) {
    hits.push_back(p);
    return 0.0;
  });
  return hits;
}

/// Returns the cell of a point in a 4 x 4 x 4 grid over the shape's box.
std::size_t cell_of(const Stand& stand, Point3 p) {
  const Bounds3 box = stand.shape.bounds();
  std::size_t cell = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = box.extent()[axis];
    const float x = extent > 0 ? (p[axis] - box.low[axis]) / extent : 0;
    cell = 4 * cell + static_cast<std::size_t>(std::clamp(static_cast<int>(4 * x), 0, 3));
  }
  return cell;
}

/// Statistics of random lines through a surface (Crofton). The mean number of hits gives the area,
/// and the hits are uniform over the surface.
struct LineCensus {
  std::vector<double> hits_a_line;
  /// Counts of at most one hit per line, so that they are independent.
  std::vector<double> cells = std::vector<double>(64);
};

LineCensus census(const Stand& stand, std::uint64_t seed) {
  constexpr std::size_t kLines = 60'000, kPilot = 2'000;
  RandomStream random(seed, 1);
  LineCensus result;
  std::size_t most = 1;
  for (std::size_t i = 0; i < kLines; ++i) {
    const std::vector<SurfacePoint> hits = hits_of(stand, random_line(stand, random));
    result.hits_a_line.push_back(static_cast<double>(hits.size()));
    if (i < kPilot) most = std::max(most, hits.size());
    // Each hit is kept with the same probability 1 / most.
    const auto chosen = static_cast<std::size_t>(random.next_1d() *
                                                 static_cast<float>(std::max(most, hits.size())));
    if (i >= kPilot && chosen < hits.size()) ++result.cells[cell_of(stand, hits[chosen].position)];
  }
  return result;
}

/// Tests by chi-square over both rows whether two sets of counts have the same distribution.
double two_sample_p_value(const std::vector<double>& a, const std::vector<double>& b) {
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum_a += a[i], sum_b += b[i];
  if (sum_a == 0 || sum_b == 0) return 0;
  // Scaled so that the difference of both rows has the variance of one row of counts.
  std::vector<double> observed, expected;
  const double n = 1 / (1 / sum_a + 1 / sum_b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double pooled = (a[i] + b[i]) / (sum_a + sum_b);
    observed.push_back(n * (pooled + a[i] / sum_a - b[i] / sum_b));
    expected.push_back(n * pooled);
  }
  return statistics::chi_square_test(observed, expected, 25).p_value;
}

/// Checks that a ray aimed at the sample's point from beside the surface hits it.
void expect_on_surface(const Stand& stand, const SurfacePoint& p, Check& check) {
  const float distance = 1e-2f * stand.radius;
  const Ray ray{p.position + distance * p.normal, -p.normal};
  double nearest = kInfinity;
  sum_along(stand.scene, ray, [&](const SurfacePoint& hit) {
    nearest = std::min(nearest, double{length(hit.position - p.position)});
    return 0.0;
  });
  check.expect_mostly(nearest <= 1e-3 * stand.radius + 4 * p.error, [&] {
    return fmt::format("no ray finds the sampled point {}; the nearest misses it by {:.4g}",
                       text(p.position), nearest);
  });
}

void check_area(const Stand& stand, Suite& suite) {
  Check& check = suite.check("area");
  RandomStream random(suite.seed(), 2);
  std::vector<double> cells(64);
  for (int i = 0; i < 60'000; ++i) {
    const ShapeSample s = stand.shape.sample(random.next_2d());
    ++cells[cell_of(stand, s.point.position)];
    if (i >= 2000) continue;
    check.expect(close(s.pdf * stand.shape.area(), 1, 1e-3), [&] {
      return fmt::format("the density {:.6g} of a sample is not one over the area {:.6g}", s.pdf,
                         stand.shape.area());
    });
    expect_on_surface(stand, s.point, check);
  }
  const LineCensus lines = census(stand, suite.seed());
  // E[hits] = 2 area / (4 pi R^2) for lines through a sphere of radius R (Santalo 1976).
  const double expected =
      double{stand.shape.area()} / (2 * double{kPi} * square(double{stand.radius}));
  statistics::Estimate hits = statistics::estimate(statistics::moments(lines.hits_a_line));
  hits.squared_error += square(1e-3 * expected);
  check.add_p_value(statistics::one_sample_test(hits, expected).p_value,
                    fmt::format("area() is {:.6g}, random lines tell {:.6g}", stand.shape.area(),
                                stand.shape.area() * hits.mean / expected));
  check.add_p_value(two_sample_p_value(cells, lines.cells),
                    "samples against hits of random lines, in 4 x 4 x 4 cells");
}

/// Returns points outside, near and within the shape's bounds.
std::vector<Point3> references(const Stand& stand) {
  const float r = stand.radius;
  return {stand.center + r * Vec3{1.1f, -2, 1.7f}, stand.center + r * Vec3{0.2f, 1.15f, 0.3f},
          stand.center + r * Vec3{0.05f, 0.11f, 0.23f}};
}

void check_solid_angle(const Stand& stand, Suite& suite) {
  constexpr double kRim = 2e-3;
  Check& check = suite.check("solid_angle");
  for (const Point3 from : references(stand)) {
    const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
      const ShapeSample s = stand.shape.sample_from(from, random.next_2d());
      const bool counts = s.pdf > 0 && is_well_seen(from, s.point);
      return counts ? std::optional(normalize(s.point.position - from)) : std::nullopt;
    };
    const auto density = [&](Vec3 d) {
      return sum_along(stand.scene, {from, d}, [&](const SurfacePoint& p) {
        return is_well_seen(from, p) ? double{stand.shape.pdf_from(from, p)} : 0.0;
      });
    };
    test_directions({draw, density, "from " + text(from), kRim, 3e-3, 40'000}, suite.seed(), check,
                    check);
    RandomStream random(suite.seed(), 3);
    for (int i = 0; i < 500; ++i) {
      const ShapeSample s = stand.shape.sample_from(from, random.next_2d());
      const float pdf = stand.shape.pdf_from(from, s.point);
      check.expect_mostly(close(s.pdf, pdf, 0.01), [&] {
        return fmt::format("from {}: a sample has the density {:.6g}, pdf_from() says {:.6g}",
                           text(from), s.pdf, pdf);
      });
    }
  }
}

void check_bounds(const Stand& stand, Suite& suite) {
  Check& check = suite.check("bounds");
  const Bounds3 box = stand.shape.bounds();
  check.expect(!box.empty() && is_finite(box.low) && is_finite(box.high),
               [] { return "bounds() is empty or not finite"; });
  const auto expect_inside = [&](const SurfacePoint& p, const char* what) {
    Bounds3 slack = box;
    const Vec3 e{2 * p.error, 2 * p.error, 2 * p.error};
    slack.add(box.low - e), slack.add(box.high + e);
    check.expect(slack.contains(p.position),
                 [&] { return fmt::format("{} {} lies outside", what, text(p.position)); });
  };
  RandomStream random(suite.seed(), 4);
  for (int i = 0; i < 5000; ++i) {
    expect_inside(stand.shape.sample(random.next_2d()).point, "the sample");
    for (const SurfacePoint& p : hits_of(stand, random_line(stand, random))) {
      expect_inside(p, "the hit");
    }
  }
}

/// Checks that a hit lies on its ray and that its normals are unit and on one side.
void expect_consistent(const Ray& ray, float t, const SurfacePoint& p, float scale, Check& check) {
  const Point3 on_ray = ray.at(t);
  // Positions keep their error as a distance from edges, which a slanted view stretches.
  const float slack =
      1e-4f * scale + 8 * p.error / std::max(abs_dot(p.normal, ray.direction), 1e-2f);
  check.expect(length(p.position - on_ray) <= slack, [&] {
    return fmt::format("the hit {} lies {:.4g} beside its ray", text(p.position),
                       length(p.position - on_ray));
  });
  const Frame& f = p.shading;
  const bool orthonormal = std::abs(length(f.s) - 1) < 1e-3f && std::abs(length(f.t) - 1) < 1e-3f &&
                           abs_dot(f.s, f.t) < 1e-3f && abs_dot(f.s, f.n) < 1e-3f &&
                           length(cross(f.s, f.t) - f.n) < 2e-3f;
  check.expect(std::abs(length(p.normal) - 1) < 1e-3f && orthonormal && dot(f.n, p.normal) > 0,
               [&] { return "normal or shading frame is wrong at " + text(p.position); });
  check.expect(
      p.error >= 0 && std::isfinite(p.error) && std::isfinite(p.uv.x) && std::isfinite(p.uv.y),
      [&] { return "error or uv is not finite at " + text(p.position); });
}

void check_intersection(const Stand& stand, Suite& suite) {
  Check& check = suite.check("intersection");
  RandomStream random(suite.seed(), 5);
  int met = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Ray ray = random_line(stand, random);
    SurfacePoint p;
    const float t = stand.scene.intersect(ray, p);
    if (t == kInfinity) continue;
    ++met;
    expect_consistent(ray, t, p, stand.radius, check);
    const Ray up_to{ray.origin, ray.direction, 1.001f * t},
        before{ray.origin, ray.direction, 0.999f * t};
    check.expect_mostly(stand.scene.occluded(up_to) && !stand.scene.occluded(before),
                        [&] { return "hit and occlusion disagree at " + text(p.position); });
  }
  check.expect(met > 20, [] { return "random lines never meet the surface"; });
}

/// Checks that rays leaving a hit do not meet it again, at any angle that is not nearly tangential.
void check_self_intersection(const Stand& stand, Suite& suite) {
  Check& check = suite.check("self_intersection");
  RandomStream random(suite.seed(), 6);
  for (int i = 0; i < 20'000; ++i) {
    SurfacePoint p;
    if (stand.scene.intersect(random_line(stand, random), p) == kInfinity) continue;
    const Vec3 direction = normalize(warp::sphere_from_square(random.next_2d()));
    const float cosine = abs_dot(direction, p.normal);
    if (cosine < 0.05f) continue;
    SurfacePoint again;
    const float t = stand.scene.intersect({p.origin_towards(direction), direction}, again);
    check.expect(!(t <= 4 * p.error / cosine && again.primitive == p.primitive), [&] {
      return fmt::format("a ray from {} towards {} meets its own surface at {:.4g}",
                         text(p.position), text(direction), t);
    });
  }
}

void check_determinism(const Stand& stand, Suite& suite) {
  Check& check = suite.check("determinism");
  RandomStream random(suite.seed(), 7);
  for (int i = 0; i < 500; ++i) {
    const Vec2 u = random.next_2d();
    const Point3 from = references(stand)[0];
    const ShapeSample a = stand.shape.sample(u), c = stand.shape.sample_from(from, u);
    const ShapeSample b = stand.shape.sample(u), d = stand.shape.sample_from(from, u);
    check.expect(a.point.position == b.point.position && c.point.position == d.point.position &&
                     c.pdf == d.pdf,
                 [] { return "the same numbers give another sample"; });
  }
}

}  // namespace

void check_shape(const Ref<Shape>& shape, Suite& suite) {
  const Stand stand(shape);
  check_area(stand, suite);
  check_solid_angle(stand, suite);
  check_bounds(stand, suite);
  check_intersection(stand, suite);
  check_self_intersection(stand, suite);
  check_determinism(stand, suite);
}

}  // namespace pharos::conformance
