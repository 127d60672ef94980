#include "agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/math/distributions/students_t.hpp>
#include <doctest/doctest.h>
#include <fmt/format.h>

namespace pharos::testing {

Renders render_seeds(LoadedConfig loaded, int count, std::uint64_t first_seed) {
  Renders renders;
  for (int i = 0; i < count; ++i) {
    loaded.config.seed = first_seed + static_cast<std::uint64_t>(i);
    RenderResult result = RenderJob(loaded.config).run();
    renders.images.push_back(std::move(result.image));
    renders.samples_per_pixel = result.samples_per_pixel;
  }
  return renders;
}

Ratio ratio_of(const statistics::Estimate& a, const statistics::Estimate& b) {
  const double relative_a = a.squared_error / (a.mean * a.mean);
  const double relative_b = b.squared_error / (b.mean * b.mean);
  const double both = relative_a + relative_b;
  // Welch-Satterthwaite degrees of freedom for the sum of both relative errors.
  const double freedom = both * both /
                         (relative_a * relative_a / a.degrees_of_freedom +
                          relative_b * relative_b / b.degrees_of_freedom);
  const double quantile = boost::math::quantile(boost::math::students_t(freedom), 0.995);
  return {a.mean / b.mean, a.mean / b.mean * quantile * std::sqrt(both)};
}

void print_agreement(const std::string& name, double spp,
                     const statistics::ImageAgreement& result) {
  static bool has_heading = false;
  if (!std::exchange(has_heading, true)) {
    fmt::print("{:<32}{:>6}  {:<24}{:>10}{:>10}   detectable bias of\n", "", "spp",
               "quotient of means", "regions", "least p");
    fmt::print("{:<92} image   region (median, worst)\n", "");
  }
  const Ratio ratio = ratio_of(result.whole_image.a, result.whole_image.b);
  fmt::print("{:<32}{:>6.0f}  {:.5f} +- {:<12.5f}{:>10}{:>10.3g}{:>9.2f} %{:>8.2f} %{:>8.2f} %\n",
             name, spp, ratio.value, ratio.half_width, result.regions.size(),
             result.smallest_adjusted_p, 100 * result.whole_image.detectable_bias,
             100 * result.median_region_bias, 100 * result.worst_region_bias);
  std::fflush(stdout);
}

void check_agreement(const statistics::ImageAgreement& result) {
  REQUIRE(!result.regions.empty());
  const statistics::RegionTest& worst =
      *std::min_element(result.regions.begin(), result.regions.end(),
                        [](const auto& x, const auto& y) { return x.p_value < y.p_value; });
  CHECK_MESSAGE(result.proven(),
                fmt::format("{}; least likely at ({}, {}) to ({}, {}): {:.5g} and {:.5g}",
                            result.summary(), worst.region.x0, worst.region.y0, worst.region.x1,
                            worst.region.y1, worst.a.mean, worst.b.mean));
}

void check_bias_is_seen(Renders renders, const statistics::ImageSide& other,
                        const statistics::AgreementOptions& options) {
  for (Image& image : renders.images) {
    for (float& value : image.values()) value *= 1.03f;
  }
  CHECK_FALSE(statistics::compare_images(renders.side(), other, options).agree);
}

}  // namespace pharos::testing
