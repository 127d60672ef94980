#include <fmt/format.h>

#include <pharos/conformance/suites.h>
#include <pharos/core/random.h>
#include <pharos/statistics/quadrature.h>

namespace pharos::conformance {
namespace {

constexpr int kOffsets = 2000;

/// Returns an offset that is uniform in the square of half-width `half`.
Vec2 random_offset(RandomStream& random, float half) {
  const Vec2 u = random.next_2d();
  return {half * (2 * u.x - 1), half * (2 * u.y - 1)};
}

std::string text(Vec2 offset) {
  return fmt::format("offset ({:.6g}, {:.6g})", offset.x, offset.y);
}

void check_support(const Filter& filter, Suite& suite) {
  Check& check = suite.check("support");
  const float r = filter.radius();
  check.expect(r > 0 && std::isfinite(r), [&] { return fmt::format("radius() is {}", r); });
  RandomStream random(suite.seed());
  for (int i = 0; i < kOffsets; ++i) {
    const Vec2 offset = random_offset(random, 4 * r);
    if (std::max(std::abs(offset.x), std::abs(offset.y)) <= 1.0001f * r) continue;
    check.expect(filter.evaluate(offset) == 0,
                 [&] { return text(offset) + " is beyond the radius, yet has weight"; });
  }
}

void check_integral(const Filter& filter, Suite& suite) {
  constexpr double kTolerance = 0.01;
  const double r = filter.radius();
  const auto value = [&](double x, double y) {
    return double{filter.evaluate({static_cast<float>(x), static_cast<float>(y)})};
  };
  const statistics::Rectangle square{-r, r, -r, r};
  const auto found = statistics::integrate(value, square, {.tolerance = 1e-4 * r * r});
  const double claimed = filter.integral();
  suite.check("integral")
      .expect(std::abs(claimed - found.value) <=
                  kTolerance * std::abs(found.value) + std::min(found.error, 0.01 * r * r),
              [&] {
                return fmt::format("integral() is {:.6g}, quadrature finds {:.6g}", claimed,
                                   found.value);
              });
  suite.check("normalizable").expect(claimed > 0 && std::isfinite(claimed), [&] {
    return fmt::format("integral() is {}", claimed);
  });
}

void check_symmetry(const Filter& filter, Suite& suite) {
  Check& check = suite.check("symmetry");
  RandomStream random(suite.seed(), 1);
  for (int i = 0; i < kOffsets; ++i) {
    const Vec2 offset = random_offset(random, filter.radius());
    const float weight = filter.evaluate(offset);
    for (const Vec2 mirrored : {Vec2{-offset.x, offset.y}, Vec2{offset.x, -offset.y}}) {
      check.expect(close(weight, filter.evaluate(mirrored), 1e-4, 1e-6),
                   [&] { return text(offset) + " and its mirror image differ"; });
    }
  }
}

void check_finite(const Filter& filter, Suite& suite) {
  Check& check = suite.check("finite");
  const float r = filter.radius();
  for (const float x : {0.0f, 1e-42f, 1e-20f, 0.5f * r, std::nextafter(r, 0.0f), r, 1e20f}) {
    for (const float y : {-0.0f, -1e-42f, -0.5f * r, -r, -1e20f, 1e30f}) {
      check.expect(std::isfinite(filter.evaluate({x, y})), [&] {
        return text({x, y}) + " has a weight that is not finite";
      });
    }
  }
}

}  // namespace

void check_filter(const Filter& filter, Suite& suite) {
  check_support(filter, suite);
  check_integral(filter, suite);
  check_symmetry(filter, suite);
  check_finite(filter, suite);
}

}  // namespace pharos::conformance
