#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include <pharos/conformance/suites.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/goodness_of_fit.h>

namespace pharos::conformance {
namespace {

constexpr int kBins = 40;

Ray stage_ray(int i, float t_max) {
  RandomStream random(17, static_cast<std::uint64_t>(i));
  const Vec3 direction = warp::sphere_from_square(random.next_2d());
  return {{random.next_1d(), random.next_1d(), random.next_1d()}, direction, t_max};
}

/// Returns shares of the channels. Some of them are zero.
Rgb stage_shares(int i) {
  static const std::array all{Rgb(1.0f / 3), Rgb(0.7f, 0.2f, 0.1f), Rgb(0, 0.5f, 0.5f),
                              Rgb(0, 0, 1)};
  return all[static_cast<std::size_t>(i) % all.size()];
}

std::string text(const Ray& ray) {
  return fmt::format("along ({:.3g}, {:.3g}, {:.3g}) for {:.4g}", ray.direction.x, ray.direction.y,
                     ray.direction.z, ray.t_max);
}

/// Returns the distance within which half of the draws scatter; 1 if draws hardly ever scatter.
float scale_of(const Medium& medium) {
  const Ray ray = stage_ray(0, 1e6f);
  std::vector<float> distances;
  RandomStream random(3);
  for (int i = 0; i < 1001; ++i) {
    const float channel = random.next_1d();
    const DistanceSample s = medium.sample(ray, stage_shares(0), channel, random.next_1d());
    distances.push_back(s.scattered ? s.t : ray.t_max);
  }
  std::nth_element(distances.begin(), distances.begin() + 500, distances.end());
  return distances[500] < ray.t_max && distances[500] > 0 ? distances[500] : 1;
}

/// Returns the integral of MediumLeg::scatter_pdf over [a, b] by Simpson's rule.
double scattered_between(const Medium& medium, const Ray& ray, Rgb shares, double a, double b) {
  constexpr int kHalves = 16;
  const double h = (b - a) / (2 * kHalves);
  double sum = 0;
  for (int i = 0; i <= 2 * kHalves; ++i) {
    const double weight = i == 0 || i == 2 * kHalves ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * medium.leg(ray, shares, static_cast<float>(a + i * h)).scatter_pdf;
  }
  return sum * h / 3;
}

/// Compares the distances of draws, and the number of draws that pass, with the densities.
void check_distances(const Medium& medium, Suite& suite) {
  Check &chi_square = suite.check("chi_square"), &integral = suite.check("integral");
  const float scale = scale_of(medium);
  constexpr int kDraws = 40'000;
  int stage = 0;
  for (const float reach : {0.3f, 1.0f, 5.0f, 1.0f}) {
    const Ray ray = stage_ray(stage, reach * scale);
    const Rgb shares = stage_shares(stage);
    std::vector<double> observed(kBins + 1), expected(kBins + 1);
    RandomStream random(suite.seed(), static_cast<std::uint64_t>(stage++));
    for (int i = 0; i < kDraws; ++i) {
      const float channel = random.next_1d();
      const DistanceSample s = medium.sample(ray, shares, channel, random.next_1d());
      chi_square.expect(!s.scattered || (s.t >= 0 && s.t < ray.t_max),
                        [&] { return text(ray) + ": a draw lies beyond the end"; });
      const auto bin = static_cast<int>(kBins * (s.t / ray.t_max));
      ++observed[static_cast<std::size_t>(s.scattered ? std::clamp(bin, 0, kBins - 1) : kBins)];
    }
    for (int i = 0; i < kBins; ++i) {
      const double step = double{ray.t_max} / kBins;
      expected[static_cast<std::size_t>(i)] =
          kDraws * scattered_between(medium, ray, shares, i * step, (i + 1) * step);
    }
    expected[kBins] = kDraws * double{medium.leg(ray, shares, ray.t_max).pass_probability};
    double total = 0;
    for (double& e : expected) total += e;
    integral.expect(std::abs(total / kDraws - 1) < 2e-3, [&] {
      return fmt::format("{}: scattering and passing add up to {:.5g}", text(ray), total / kDraws);
    });
    for (double& e : expected) e *= kDraws / total;
    chi_square.add_p_value(statistics::chi_square_test(observed, expected).p_value, text(ray));
  }
}

Rgb transmittance(const Medium& medium, const Ray& ray, float t) {
  return medium.leg(ray, stage_shares(0), t).transmittance;
}

/// Checks that transmittance is a fraction in each channel that multiplies along a ray.
void check_transmittance(const Medium& medium, Suite& suite) {
  Check& check = suite.check("transmittance");
  const float scale = scale_of(medium);
  for (int i = 0; i < 20; ++i) {
    const float a = scale * 0.1f * static_cast<float>(i), b = scale * 0.7f;
    const Ray whole = stage_ray(i, a + b);
    const Ray rest{whole.at(a), whole.direction, b};
    const Rgb left = transmittance(medium, whole, a + b);
    check.expect(is_non_negative(left) && max_component(left) <= 1.0001f,
                 [&] { return text(whole) + ": not a share of the light"; });
    const Rgb product = transmittance(medium, whole, a) * transmittance(medium, rest, b);
    check.expect(close(left, product, 1e-3, 1e-6), [&] {
      return fmt::format("{}: what is left is not the product of both parts", text(whole));
    });
  }
}

/// Checks that distances are drawn wherever light is scattered. Otherwise light would be missing.
void check_support(const Medium& medium, Suite& suite) {
  Check& check = suite.check("support");
  const float scale = scale_of(medium);
  for (int i = 0; i < 20; ++i) {
    const Ray ray = stage_ray(i, 3 * scale);
    const float t = ray.t_max * (static_cast<float>(i) + 0.5f) / 20;
    const MediumLeg leg = medium.leg(ray, stage_shares(0), t);
    const bool scatters = !is_black(medium.scattering(ray.at(t)) * leg.transmittance);
    check.expect(!scatters || leg.scatter_pdf > 0, [&] {
      return fmt::format("{}: light scatters at {:.4g}, where no draw ends", text(ray), t);
    });
    check.expect(is_non_negative(medium.scattering(ray.at(t))),
                 [&] { return text(ray) + ": scattering() is negative or not finite"; });
  }
}

/// Checks that the end of a ray only cuts draws off.
void check_end(const Medium& medium, Suite& suite) {
  Check& check = suite.check("end");
  const float scale = scale_of(medium);
  RandomStream random(suite.seed(), 99);
  for (int i = 0; i < 1000; ++i) {
    const Ray far = stage_ray(i, 20 * scale);
    Ray near = far;
    near.t_max = scale;
    const float channel = random.next_1d(), u = random.next_1d();
    const DistanceSample expected = medium.sample(far, stage_shares(i), channel, u);
    const DistanceSample s = medium.sample(near, stage_shares(i), channel, u);
    const bool scatters = expected.scattered && expected.t < near.t_max;
    check.expect(s.scattered == scatters && (!scatters || s.t == expected.t), [&] {
      return fmt::format("{}: a draw depends on the end of the ray", text(near));
    });
  }
}

void check_finite(const Medium& medium, Suite& suite) {
  Check& check = suite.check("finite");
  for (const float t : {0.0f, 1e-38f, 1.0f, 1e20f, std::numeric_limits<float>::infinity()}) {
    const Ray ray = stage_ray(0, t);
    const MediumLeg leg = medium.leg(ray, stage_shares(1), t);
    for (const float v : {leg.scatter_pdf, leg.pass_probability}) {
      check.expect(is_non_negative(v), [&] {
        return fmt::format("a density at {} is negative or not finite: {}", t, v);
      });
    }
    check.expect(is_non_negative(leg.transmittance),
                 [&] { return fmt::format("the transmittance for {} is not finite", t); });
    check.expect(medium.leg(ray, stage_shares(2), t).pass_probability <= 1.0001f,
                 [&] { return fmt::format("more than all rays pass {}", t); });
    for (const float u : {0.0f, 0.5f, 0.99999994f}) {
      const DistanceSample s = medium.sample(ray, stage_shares(0), u, u);
      check.expect(!s.scattered || (std::isfinite(s.t) && s.t >= 0 && s.t < t), [&] {
        return fmt::format("the draw of {} on a ray of length {} ends at {}", u, t, s.t);
      });
    }
  }
}

}  // namespace

void check_medium(const Medium& medium, Suite& suite) {
  check_distances(medium, suite);
  check_transmittance(medium, suite);
  check_support(medium, suite);
  check_end(medium, suite);
  check_finite(medium, suite);
}

}  // namespace pharos::conformance
