#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>

namespace pharos::conformance {
namespace {

/// Systematic error of quadrature and float densities that is not the plugin's [1].
constexpr double kSlack = 0.005;

void test_integral(const statistics::DensityFit& fit, const DirectionFit& setup, Check& integral) {
  const double tested = 0.5 * static_cast<double>(setup.draws);
  const double sigma = std::sqrt(std::max(fit.missed * (1 - fit.missed), 1 / tested) / tested);
  const double deviation = std::abs(fit.integral + fit.missed - 1);
  const double excess = std::max(0.0, deviation - kSlack - fit.integral_error);
  integral.add_p_value(normal_p_value(excess / sigma),
                       fmt::format("{}: integral {:.4f} +- {:.1g}, without result {:.4f}",
                                   setup.where, fit.integral, fit.integral_error, fit.missed));
}

}  // namespace

double normal_p_value(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

void test_directions(const DirectionFit& setup, std::uint64_t seed, Check& chi_square,
                     Check& integral) {
  const statistics::DensityFit fit = statistics::fit_direction_density(
      setup.draw, setup.density,
      {.draws = setup.draws, .seed = seed, .cells = 60, .quadrature_tolerance = 2e-3});
  chi_square.add_p_value(
      fit.chi_square.p_value,
      fmt::format("{}: chi-square {:.1f} with {} degrees of freedom", setup.where,
                  fit.chi_square.statistic, fit.chi_square.degrees_of_freedom));
  const double outside = static_cast<double>(fit.outside_support);
  chi_square.expect(outside <= setup.rim * static_cast<double>(setup.draws), [&] {
    return fmt::format("{}: the density of {} draws is not positive and finite", setup.where,
                       fit.outside_support);
  });
  test_integral(fit, setup, integral);
}

}  // namespace pharos::conformance
