#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/frame.h>
#include <pharos/core/random.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

constexpr int kWidth = 64, kHeight = 48;
constexpr const char* kNoResponse = "film positions do not belong to directions";

/// Whether a direction says where it lies on the film; not so for parallel projections.
bool has_response(const PreparedSensor& sensor) {
  RandomStream random(1);
  for (int i = 0; i < 1000; ++i) {
    const LensPoint lens = sensor.sample_lens(random.next_2d());
    if (sensor.response(lens, sensor.ray(lens, random.next_2d()).direction)) return true;
  }
  return false;
}

void check_inverse(const PreparedSensor& sensor, Suite& suite) {
  Check& check = suite.check("inverse");
  const bool inverts = has_response(sensor);
  if (!inverts) check.not_applicable(kNoResponse);
  RandomStream random(suite.seed());
  for (int i = 0; i < 5000; ++i) {
    const LensPoint lens = sensor.sample_lens(random.next_2d());
    const Vec2 film = random.next_2d();
    const Ray ray = sensor.ray(lens, film);
    if (!is_finite(ray.origin) || std::abs(length(ray.direction) - 1) > 1e-3f) {
      check.expect(false, [&] {
        return fmt::format("film ({}, {}): the ray is not finite, or its direction not unit",
                           film.x, film.y);
      });
    }
    if (!inverts) continue;
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

/// Directions of uniform film positions against the density that the response claims.
void check_density(const PreparedSensor& sensor, Suite& suite) {
  constexpr double kRim = 1e-3;
  Check& chi_square = suite.check("chi_square");
  Check& integral = suite.check("integral");
  if (!has_response(sensor)) {
    chi_square.not_applicable(kNoResponse);
    integral.not_applicable(kNoResponse);
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

  /// How many positions lie in each cell of a grid of `edge` x `edge` cells.
  std::vector<double> counts(int edge) const {
    std::vector<double> all(static_cast<std::size_t>(edge) * edge);
    for (const Vec3 p : points_) {
      const Vec3 relative = p - bounds_.low, extent = bounds_.extent();
      const auto cell = [edge](float v, float size) {
        return std::clamp(static_cast<int>(v / size * static_cast<float>(edge)), 0, edge - 1);
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

/// The counts of cells that lie within the lens: all their neighbours, up to two away, have points.
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
  constexpr int kEdge = 16, kDraws = 60'000;
  Check& check = suite.check("lens");
  const LensPlane plane(sensor, suite.seed(), kDraws);
  check.expect(plane.finite(), [] { return "positions are not finite, or normals not unit"; });
  if (plane.is_point()) return check.not_applicable("the lens is a point");
  check.expect(plane.is_flat(), [] { return "the lens is not flat across its normal"; });
  const std::vector<double> observed = inner_counts(plane.counts(kEdge), kEdge);
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
  check_inverse(*prepared, suite);
  check_density(*prepared, suite);
  check_lens(*prepared, suite);
  check_determinism(*prepared, suite);
}

}  // namespace pharos::conformance
