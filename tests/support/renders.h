#pragma once

#include <string>
#include <vector>

#include <pharos/rendering/render_config.h>
#include <pharos/rendering/render_job.h>

namespace pharos::testing {

/// All plugins of the build, test-only and deliberately faulty ones included.
const Registry& registry();

/// A config given as text.
LoadedConfig config_from(const std::string& yaml);

/// Renders a config given as text; `threads` 0: all cores.
RenderResult render(const std::string& yaml, int threads = 0);

/// Mean of all pixels and channels.
double image_mean(const Image& image);

/// Mean of several independent numbers and its standard error.
struct Estimate {
  double mean = 0;
  double standard_error = 0;
};
Estimate estimate(const std::vector<double>& values);

/// Image means of a config rendered with seeds 1 … `runs`; the text must not state a seed.
Estimate mean_over_seeds(const std::string& yaml, int runs);

}  // namespace pharos::testing
