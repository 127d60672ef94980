#pragma once

#include <string>
#include <vector>

#include <pharos/statistics/image_agreement.h>

#include "renders.h"

namespace pharos::testing {

/// Independent renders of one config, with their samples a pixel.
struct Renders {
  std::vector<Image> images;
  double samples_per_pixel = 0;

  statistics::ImageSide side() const {
    return statistics::ImageSide::of_renders(images, samples_per_pixel);
  }
};

/// Renders with seeds `first_seed`, `first_seed` + 1, …
Renders render_seeds(LoadedConfig loaded, int count, std::uint64_t first_seed = 1);

/// The quotient of two means and the half-width of its 99 % confidence interval.
struct Ratio {
  double value, half_width;
};
Ratio ratio_of(const statistics::Estimate& a, const statistics::Estimate& b);

/// Prints a line about a comparison, and a heading before the first one.
void print_agreement(const std::string& name, double spp, const statistics::ImageAgreement& result);

/// Checks that the images agree in a test that could have told otherwise, and says where they are
/// least likely to.
void check_agreement(const statistics::ImageAgreement& result);

/// Checks that renders made 3 % brighter would not agree with `other`.
void check_bias_is_seen(Renders renders, const statistics::ImageSide& other,
                        const statistics::AgreementOptions& options = {});

}  // namespace pharos::testing
