#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/frame.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr const char* kNoDensity = "the sensor sees one direction";

/// Checks a sensor that sees one direction: all rays are parallel, and no direction has a response.
void expect_parallel(const PreparedSensor& sensor, const LensPoint& lens, const Ray& ray,
                     Vec3 elsewhere, Check& check) {
  const Vec3 first = sensor.ray(sensor.sample_lens({0.5f, 0.5f}), {0.5f, 0.5f}).direction;
  check.expect(length(ray.direction - first) < 1e-5f,
               [] { return "the sensor sees one direction, yet rays are not parallel"; });
  check.expect(!sensor.response(lens, ray.direction) && !sensor.response(lens, elsewhere),
               [] { return "the sensor sees one direction, yet a direction has a response"; });
}

void check_inverse(const PreparedSensor& sensor, bool one_direction, Suite& suite) {
  Check& check = suite.check("inverse");
  RandomStream random(suite.seed());
  for (int i = 0; i < 5000; ++i) {
    const LensPoint lens = sensor.sample_lens(random.next_2d());
    const Vec2 film = random.next_2d();
    const Ray ray = sensor.ray(lens, film);
    check.expect(is_finite(ray.origin) && std::abs(length(ray.direction) - 1) <= 1e-3f, [&] {
      return fmt::format("film ({}, {}): the ray is not finite, or its direction not unit", film.x,
                         film.y);
    });
    if (one_direction) {
      expect_parallel(sensor, lens, ray, warp::sphere_from_square(random.next_2d()), check);
      continue;
    }
    const auto response = sensor.response(lens, ray.direction);
    check.expect_mostly(
        response && response->direction_pdf > 0 && std::abs(response->film.x - film.x) < 1e-3f &&
            std::abs(response->film.y - film.y) < 1e-3f,
        [&] {
          return fmt::format(
              "film ({}, {}): the response to its ray is {}", film.x, film.y,
              response ? fmt::format("({}, {})", response->film.x, response->film.y) : "empty");
        });
  }
}

/// Compares directions of uniform film positions with the density of response().
void check_density(const PreparedSensor& sensor, bool one_direction, Suite& suite) {
  constexpr double kRim = 1e-3;
  Check& chi_square = suite.check("chi_square");
  Check& integral = suite.check("integral");
  if (one_direction) {
    chi_square.not_applicable(kNoDensity);
    integral.not_applicable(kNoDensity);
    return;
  }
  for (const Vec2 u : {Vec2{0.3f, 0.6f}, Vec2{0.9f, 0.1f}}) {
    const LensPoint lens = sensor.sample_lens(u);
    const auto draw = [&](RandomStream& random) -> std::optional<Vec3> {
      return sensor.ray(lens, random.next_2d()).direction;
    };
    const auto density = [&](Vec3 d) -> double {
      const auto response = sensor.response(lens, d);
      return response ? response->direction_pdf : 0;
    };
    test_directions({draw, density, fmt::format("lens u ({}, {})", u.x, u.y), kRim}, suite.seed(),
                    chi_square, integral);
  }
}

/// Checks that connect() leads points along rays back to their film positions. The density must be
/// the fraction of the film between neighboring rays, over the area that these rays span.
void check_connection(const PreparedSensor& sensor, Suite& suite) {
  constexpr float kStep = 0.01f;
  Check& check = suite.check("connection");
  RandomStream random(suite.seed(), 3);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u_lens = random.next_2d(), film = 0.02f * Vec2{1, 1} + 0.96f * random.next_2d();
    const LensPoint lens = sensor.sample_lens(u_lens);
    const Ray ray = sensor.ray(lens, film);
    const Point3 at = ray.at(0.5f + 4 * random.next_1d());
    const auto way = sensor.connect(at, u_lens);
    check.expect_mostly(
        way && std::abs(way->film.x - film.x) < 1e-3f && std::abs(way->film.y - film.y) < 1e-3f &&
            length(way->direction + ray.direction) < 1e-3f &&
            std::abs(length(at - ray.origin) - way->distance) < 1e-3f * way->distance,
        [&] {
          return fmt::format("film ({}, {}): the way back from its ray {}", film.x, film.y,
                             way ? "leads elsewhere" : "is not there");
        });
    if (!way) continue;
    const auto across = [&](Vec2 shift) {
      const Ray beside = sensor.ray(lens, film + shift);
      const float t = dot(at - beside.origin, ray.direction) / dot(beside.direction, ray.direction);
      return beside.at(t);
    };
    const Vec3 dx = across({kStep / 2, 0}) - across({-kStep / 2, 0});
    const Vec3 dy = across({0, kStep / 2}) - across({0, -kStep / 2});
    const double found = kStep * kStep / double{length(cross(dx, dy))};
    check.expect_mostly(close(way->pdf, found, 0.01), [&] {
      return fmt::format("film ({}, {}): a density of {:.5g}, rays have {:.5g}", film.x, film.y,
                         way->pdf, found);
    });
  }
}

/// Checks that a connected point lies in front of the lens, on the ray of the film position of the
/// connection.
void check_seen(const PreparedSensor& sensor, Suite& suite) {
  Check& check = suite.check("seen");
  RandomStream random(suite.seed(), 4);
  for (int i = 0; i < 4000; ++i) {
    const Vec2 u_lens = random.next_2d();
    const Point3 lens = sensor.sample_lens(u_lens).position;
    const Point3 at = lens + 4 * random.next_1d() * warp::sphere_from_square(random.next_2d());
    const auto way = sensor.connect(at, u_lens);
    if (!way) continue;
    const Ray ray = sensor.ray(way->lens, way->film);
    const float t = dot(at - ray.origin, ray.direction);
    check.expect_mostly(t > 0 && length(ray.at(t) - at) < 1e-3f * (t + 1), [&] {
      return fmt::format("a point beside the ray of film ({}, {}), or behind it", way->film.x,
                         way->film.y);
    });
  }
  check.not_applicable("no point near the lens is seen");
}

/// Lens positions in the plane of the lens, scaled to [0,1)^2 by their extent.
class LensPlane {
 public:
  LensPlane(const PreparedSensor& sensor, std::uint64_t seed, int draws) {
    RandomStream random(seed, 1);
    const LensPoint first = sensor.sample_lens({0.5f, 0.5f});
    const Frame frame = Frame::from_normal(first.normal);
    for (int i = 0; i < draws; ++i) {
      const LensPoint lens = sensor.sample_lens(random.next_2d());
      const Vec3 local = frame.to_local(lens.position - first.position);
      bounds_.add(local);
      points_.push_back(local);
      finite_ &= is_finite(lens.position) && std::abs(length(lens.normal) - 1) < 1e-3f;
    }
  }

  bool finite() const { return finite_; }
  bool is_point() const { return bounds_.diagonal() == 0; }
  bool is_flat() const { return bounds_.extent().z <= 1e-3f * bounds_.diagonal(); }

  /// Returns the number of positions in each cell of a grid of `edge` x `edge` cells.
  std::vector<double> counts(int edge) const {
    std::vector<double> all(static_cast<std::size_t>(edge) * edge);
    for (const Vec3 p : points_) {
      const Vec3 relative = p - bounds_.low, extent = bounds_.extent();
      const auto cell = [edge](float v, float size) {
        const float at = size > 0 ? v / size : 0;
        return std::clamp(static_cast<int>(at * static_cast<float>(edge)), 0, edge - 1);
      };
      ++all[static_cast<std::size_t>(cell(relative.y, extent.y)) * edge +
            cell(relative.x, extent.x)];
    }
    return all;
  }

 private:
  Bounds3 bounds_;
  std::vector<Vec3> points_;
  bool finite_ = true;
};

/// Returns the counts of cells within the lens. All neighbors of such a cell, up to two away, have
/// points.
std::vector<double> inner_counts(const std::vector<double>& counts, int edge) {
  std::vector<double> inner;
  for (int y = 2; y < edge - 2; ++y) {
    for (int x = 2; x < edge - 2; ++x) {
      bool within = true;
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          within &= counts[static_cast<std::size_t>(y + j) * edge + (x + i)] > 0;
        }
      }
      if (within) inner.push_back(counts[static_cast<std::size_t>(y) * edge + x]);
    }
  }
  return inner;
}

void check_lens(const PreparedSensor& sensor, Suite& suite) {
  constexpr int kEdge = 32, kDraws = 60'000;
  constexpr std::size_t kFewestCells = 16;
  Check& check = suite.check("lens");
  const LensPlane plane(sensor, suite.seed(), kDraws);
  check.expect(plane.finite(), [] { return "positions are not finite, or normals not unit"; });
  if (plane.is_point()) return check.not_applicable("the lens is a point");
  check.expect(plane.is_flat(), [] { return "the lens is not flat across its normal"; });
  const std::vector<double> observed = inner_counts(plane.counts(kEdge), kEdge);
  check.expect(observed.size() >= kFewestCells, [&] {
    return fmt::format(
        "only {} of {} x {} cells lie within the lens: its positions are on a line or rim",
        observed.size(), kEdge, kEdge);
  });
  if (observed.empty()) return;
  double total = 0;
  for (const double n : observed) total += n;
  const std::vector<double> expected(observed.size(), total / static_cast<double>(observed.size()));
  check.add_p_value(statistics::chi_square_test(observed, expected).p_value,
                    fmt::format("counts in {} cells within the lens", observed.size()));
}

void check_determinism(const PreparedSensor& sensor, Suite& suite) {
  Check& check = suite.check("determinism");
  RandomStream random(suite.seed(), 2);
  for (int i = 0; i < 500; ++i) {
    const Vec2 u = random.next_2d(), film = random.next_2d();
    const LensPoint a = sensor.sample_lens(u), b = sensor.sample_lens(u);
    const Ray r = sensor.ray(a, film), s = sensor.ray(b, film);
    check.expect(a.position == b.position && r.direction == s.direction && r.origin == s.origin,
                 [] { return "the same numbers give another ray"; });
  }
}

}  // namespace

void check_sensor(const Sensor& sensor, Suite& suite) {
  const auto prepared = sensor.prepare(kWidth, kHeight);
  const bool one_direction = sensor.sees_one_direction();
  check_inverse(*prepared, one_direction, suite);
  check_density(*prepared, one_direction, suite);
  check_connection(*prepared, suite);
  check_seen(*prepared, suite);
  check_lens(*prepared, suite);
  check_determinism(*prepared, suite);
}

}  // namespace pharos::conformance
