#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>

namespace pharos::conformance {
namespace {

/// Systematic relative error of quadrature and of float densities [1]. It is not the plugin's
/// fault.
constexpr double kSlack = 0.005;

/// An estimated fraction with its standard error [1].
struct Share {
  double value, error;
};

/// Estimates the fraction of draws with a result, to a relative error of about 0.2 % if possible.
Share share_with_result(const DirectionFit& setup, double missed, std::uint64_t seed) {
  constexpr double kRelativeError = 0.002, kMostDraws = 400'000;
  const double wanted = missed / std::max(1 - missed, 1e-9) / (kRelativeError * kRelativeError);
  const double n = std::clamp(wanted, 0.5 * static_cast<double>(setup.draws), kMostDraws);
  RandomStream random(seed, 1);
  double hits = 0;
  for (double i = 0; i < n; ++i) hits += setup.draw(random) ? 1 : 0;
  const double share = hits / n;
  return {share, std::sqrt(std::max(share * (1 - share), 1 / n) / n)};
}

void test_integral(const statistics::DensityFit& fit, const DirectionFit& setup, std::uint64_t seed,
                   Check& integral) {
  integral.expect(fit.invalid_nodes == 0, [&] {
    return fmt::format("{}: the density is negative or not finite in {} directions of quadrature",
                       setup.where, fit.invalid_nodes);
  });
  const Share share = share_with_result(setup, fit.missed, seed);
  const double deviation = std::abs(fit.integral - share.value);
  const double excess =
      std::max(0.0, deviation - kSlack * share.value - std::min(fit.integral_error, kSlack));
  integral.add_p_value(
      normal_p_value(excess / share.error),
      fmt::format("{}: integral {:.4f} +- {:.1g}, share of draws with a result "
                  "{:.4f} +- {:.1g}",
                  setup.where, fit.integral, fit.integral_error, share.value, share.error));
}

}  // namespace

double normal_p_value(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

void test_directions(const DirectionFit& setup, std::uint64_t seed, Check& chi_square,
                     Check& integral) {
  const statistics::DensityFit fit = statistics::fit_direction_density(
      setup.draw, setup.density,
      {.draws = setup.draws, .seed = seed, .cells = 60, .quadrature_tolerance = setup.tolerance});
  chi_square.add_p_value(
      fit.chi_square.p_value,
      fmt::format("{}: chi-square {:.1f} with {} degrees of freedom", setup.where,
                  fit.chi_square.statistic, fit.chi_square.degrees_of_freedom));
  const double outside = static_cast<double>(fit.outside_support);
  chi_square.expect(outside <= setup.rim * static_cast<double>(setup.draws), [&] {
    return fmt::format("{}: the density of {} draws is not positive and finite", setup.where,
                       fit.outside_support);
  });
  test_integral(fit, setup, seed, integral);
}

}  // namespace pharos::conformance
