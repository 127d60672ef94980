#pragma once

#include "cluster_rates.h"

namespace pharos::bench {

/// A render on many machines, each with one rank.
struct ClusterJob {
  double pixels = 1920.0 * 1080;
  double samples = 65536;      ///< per pixel
  double training_part = 0.5;  ///< of the samples
  double recorded = 0;         ///< samples per pixel of an iteration that are recorded; 0: all
  double tile_pixels = 1024;   ///< of a work unit
  double threads = 32;         ///< of a rank
  double bandwidth = 0;        ///< of each machine's link, in each direction [bytes/s]
  double latency = 20e-6;      ///< of a message [s]
};

/// The ranks that learn.
enum class LearningPlace {
  rank_0,  ///< rank 0 receives all logs
  owners   ///< every rank receives the samples for its own cells
};

/// Returns the efficiency of a render on `ranks` machines: the time that one machine takes over
/// `ranks` times the time that they take. A part of an iteration takes as long as the slowest of
/// its steps that overlap: tracing, receiving, loading and learning. Then the guides are updated
/// and broadcast. Owners load less than rank 0 would, by the ratio of samples to logs. A pass ends
/// when its last work unit has been rendered.
double cluster_efficiency(const ClusterRates& rates, const ClusterJob& job, LearningPlace place,
                          double ranks);

}  // namespace pharos::bench
