#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/rendering/render_config.h>

namespace pharos::bench {

/// The costs of a guided render for each path, each update and each image. cluster_efficiency()
/// needs no other facts about a method in a scene.
struct ClusterRates {
  // For each path of a training iteration:
  double trace = 0;             ///< time of one thread to trace and record it [s]
  double log_bytes = 0;         ///< size of its log [bytes]
  double sample_bytes = 0;      ///< size of what the learners keep of its log [bytes]
  double pack = 0, unpack = 0;  ///< time of one thread to save and to load its log [s]
  double absorb_serial = 0;     ///< time to learn from it that threads cannot share [s]
  double absorb_shared = 0;     ///< time to learn from it that threads share [thread s]

  double final_trace = 0;  ///< time of one thread to trace a path that is not recorded [s]
  // For each pixel of a work unit that is not recorded:
  double tile_bytes = 0;  ///< size in the unit's film tile [bytes]
  double tile_merge = 0;  ///< time to load it and to add it to the film [s]

  /// The time of each update [s] with one thread, for iterations of `first_paths`,
  /// 2 `first_paths`, … paths, and the part of the last one that threads share.
  std::vector<double> updates;
  double update_shared = 0;
  double first_paths = 0;
  double guide_bytes = 0;  ///< size of what other ranks need to guide paths, in the end [bytes]
};

/// Trains `config` in a few iterations of doubling size, on one thread and on two threads, and
/// measures.
ClusterRates cluster_rates(const RenderConfig& config);

}  // namespace pharos::bench
