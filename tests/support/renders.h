#pragma once

#include <string>
#include <vector>

#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_job.h>

namespace pharos::testing {

/// Returns all plugins of the build, including test-only and deliberately faulty ones.
const Registry& registry();

/// Returns a config that is given as text.
LoadedConfig config_from(const std::string& yaml);

/// Renders a config that is given as text. `threads` 0 uses all cores.
RenderResult render(const std::string& yaml, int threads = 0);

/// Returns the bits of the image, of everything that was learned and of the guides' gain.
std::string bits_of(const RenderResult& result);

/// Returns the mean of all pixels and channels.
double image_mean(const Image& image);

/// The mean of several independent numbers and its standard error.
struct Estimate {
  double mean = 0;
  double standard_error = 0;
};
Estimate estimate(const std::vector<double>& values);

/// Returns the image means of a config rendered with the seeds 1 … `runs`. The text must not state
/// a seed.
Estimate mean_over_seeds(const std::string& yaml, int runs);

}  // namespace pharos::testing
