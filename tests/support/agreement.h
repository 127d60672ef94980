#pragma once

#include <string>
#include <vector>

#include <pharos/statistics/image_agreement.h>

#include "renders.h"

namespace pharos::testing {

/// Independent renders of one config, and their samples per pixel.
struct Renders {
  std::vector<Image> images;
  double samples_per_pixel = 0;

  statistics::ImageSide side() const {
    return statistics::ImageSide::of_renders(images, samples_per_pixel);
  }
};

/// Renders a config with the seeds `first_seed`, `first_seed` + 1, …
Renders render_seeds(LoadedConfig loaded, int count, std::uint64_t first_seed = 1);

/// The ratio of two means and the half-width of its 99 % confidence interval.
struct Ratio {
  double value, half_width;
};
Ratio ratio_of(const statistics::Estimate& a, const statistics::Estimate& b);

/// Prints one line about a comparison, and a heading before the first line.
void print_agreement(const std::string& name, double spp, const statistics::ImageAgreement& result);

/// Checks that the images agree and that the test had enough power to detect a difference. On
/// failure, reports the regions with the smallest p-values.
void check_agreement(const statistics::ImageAgreement& result);

/// Checks that the test would reject renders that are 3 % brighter.
void check_bias_is_seen(Renders renders, const statistics::ImageSide& other,
                        const statistics::AgreementOptions& options = {});

}  // namespace pharos::testing
