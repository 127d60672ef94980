#pragma once

#include <filesystem>
#include <vector>

#include "bench.h"

namespace pharos::bench {

/// Draws the simulated efficiencies clusters.SCENE.METHOD.NETWORK.DESIGN.RANKS: one plot for
/// each scene, network and way to learn, clusters-SCENE-NETWORK-DESIGN.svg in `folder`, with a
/// curve for each method. Throws RunError if a file cannot be written.
void write_cluster_plots(const std::filesystem::path& folder, const std::vector<Measurement>& all);

}  // namespace pharos::bench
