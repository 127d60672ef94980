#include <fmt/format.h>

#include <pharos/conformance/suites.h>
#include <pharos/core/random.h>

namespace pharos::conformance {
namespace {

std::string shown(Vec2 uv) {
  return fmt::format("uv ({:.6g}, {:.6g})", uv.x, uv.y);
}

void expect_in_range(const Texture& texture, Vec2 uv, Check& check) {
  const Rgb value = texture.evaluate({.uv = uv});
  const Rgb limit = texture.maximum();
  for (int c = 0; c < 3; ++c) {
    check.expect(value[c] <= limit[c] + 1e-5f * std::abs(limit[c]), [&] {
      return fmt::format("{}: the value {:.6g} of channel {} exceeds maximum() {:.6g}", shown(uv),
                         value[c], c, limit[c]);
    });
  }
}

void check_range(const Texture& texture, Suite& suite) {
  Check& check = suite.check("range");
  RandomStream random(suite.seed());
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 u = random.next_2d();
    expect_in_range(texture, i % 2 == 0 ? u : Vec2{20 * u.x - 10, 20 * u.y - 10}, check);
  }
}

/// Returns the mean of jittered evaluations over [0, extent)^2.
Rgb mean_over(const Texture& texture, float extent, std::uint64_t seed) {
  constexpr int kEdge = 512;
  RandomStream random(seed, 1);
  double sums[3] = {};
  for (int i = 0; i < kEdge * kEdge; ++i) {
    const Vec2 jitter = random.next_2d();
    const Vec2 uv{(static_cast<float>(i % kEdge) + jitter.x) * (extent / kEdge),
                  (static_cast<float>(i / kEdge) + jitter.y) * (extent / kEdge)};
    const Rgb value = texture.evaluate({.uv = uv});
    for (int c = 0; c < 3; ++c) sums[c] += double{value[c]} / (kEdge * kEdge);
  }
  return {static_cast<float>(sums[0]), static_cast<float>(sums[1]), static_cast<float>(sums[2])};
}

/// Checks that average() is the mean over the unit square, or over many units for patterns whose
/// periods do not fit into one.
void check_average(const Texture& texture, Suite& suite) {
  constexpr double kTolerance = 0.02;
  const Rgb claimed = texture.average();
  const Rgb unit = mean_over(texture, 1, suite.seed()), wide = mean_over(texture, 16, suite.seed());
  const double slack = 0.002 * double{max_component(texture.maximum())};  // for jittered edges
  const bool agrees =
      close(claimed, unit, kTolerance, slack) || close(claimed, wide, kTolerance, slack);
  suite.check("average").expect(agrees, [&] {
    return fmt::format(
        "average() is ({:.4g}, {:.4g}, {:.4g}), the mean over the unit square "
        "({:.4g}, {:.4g}, {:.4g}), over 16 x 16 of them ({:.4g}, {:.4g}, {:.4g})",
        claimed.r, claimed.g, claimed.b, unit.r, unit.g, unit.b, wide.r, wide.g, wide.b);
  });
}

void check_finite(const Texture& texture, Suite& suite) {
  Check& check = suite.check("finite");
  const float odd[] = {-0.0f,  1e-42f,  -1e-42f,  0.5f, 1,     kOneMinusEpsilon,
                       -1,     1234.5f, -987.25f, 1e7f, -1e7f, 1e15f,
                       -1e15f, 1e30f,   -1e30f};
  for (const float u : odd) {
    for (const float v : odd) {
      check.expect(is_finite(texture.evaluate({.uv = {u, v}})), [&] {
        return shown({u, v}) + ": the value is not finite";
      });
    }
  }
  check.expect(is_finite(texture.average()) && is_finite(texture.maximum()),
               [] { return "average() or maximum() is not finite"; });
}

void check_determinism(const Texture& texture, Suite& suite) {
  Check& check = suite.check("determinism");
  RandomStream random(suite.seed(), 2);
  Rgb last;
  Vec2 last_uv;
  for (int i = 0; i < 1000; ++i) {
    const Vec2 uv = random.next_2d();
    const Rgb value = texture.evaluate({.uv = uv});
    if (i > 0) {
      check.expect(texture.evaluate({.uv = last_uv}) == last,
                   [&] { return shown(last_uv) + ": asked again, the value is another"; });
    }
    last = value;
    last_uv = uv;
  }
}

}  // namespace

void check_texture(const Texture& texture, Suite& suite) {
  check_range(texture, suite);
  check_average(texture, suite);
  check_finite(texture, suite);
  check_determinism(texture, suite);
}

}  // namespace pharos::conformance
