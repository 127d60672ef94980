#include "cluster_model.h"

#include <algorithm>
#include <cmath>

#include <pharos/rendering/pass_sizes.h>

namespace pharos::bench {
namespace {

/// A render on a number of machines.
class Simulation {
 public:
  Simulation(const ClusterRates& rates, const ClusterJob& job, LearningPlace place, double ranks)
      : rates_(rates),
        job_(job),
        owners_(place == LearningPlace::owners ? ranks : 1),
        ranks_(ranks) {}

  /// Returns the time of the render [s].
  double run() const {
    const double training = job_.samples * job_.training_part;
    double seconds = 0, done = 0;
    for (double samples = 1; done < training; samples *= 2) {
      // What would not suffice for a larger iteration belongs to the last one.
      if (done + 3 * samples > training) samples = training - done;
      seconds += training_iteration(samples);
      done += samples;
    }
    return seconds + final_image(job_.samples - done);
  }

 private:
  double training_iteration(double samples) const {
    const double recorded = job_.recorded > 0 ? std::min(job_.recorded, samples) : samples;
    return recorded_part(recorded, samples) + unrecorded_part(samples - recorded, samples) +
           update(recorded * job_.pixels) / owners_ + exchange_of_guides();
  }

  double final_image(double samples) const { return unrecorded_part(samples, samples); }

  /// Returns the time of `part` samples per pixel of an iteration of `samples`.
  double recorded_part(double part, double samples) const {
    const double paths = part * job_.pixels, logs = sent(paths);
    const double bytes = owners_ > 1 ? rates_.sample_bytes : rates_.log_bytes;
    const double unpack = rates_.unpack * bytes / rates_.log_bytes;
    const double steps[]{tracing(part, samples, true, rates_.trace),
                         logs * bytes / owners_ / job_.bandwidth, logs * unpack / owners_,
                         paths * shared(rates_.absorb_serial, rates_.absorb_shared) / owners_};
    return *std::ranges::max_element(steps);
  }

  double unrecorded_part(double part, double samples) const {
    if (part == 0) return 0;
    const double tiles = job_.pixels * std::ceil(part / passes(samples, false).unit(0));
    const double steps[]{tracing(part, samples, false, rates_.final_trace),
                         sent(tiles) * rates_.tile_bytes / job_.bandwidth,
                         tiles * rates_.tile_merge};
    return *std::ranges::max_element(steps);
  }

  static PassSizes passes(double samples, bool records) {
    const Iteration iteration{.samples = static_cast<std::uint32_t>(samples)};
    return {iteration, records ? iteration.samples : 0, 1, 0};
  }

  /// Returns the time to trace `part` samples per pixel of an iteration of `samples`.
  double tracing(double part, double samples, bool records, double path) const {
    const auto all = static_cast<std::uint32_t>(part);
    const double tiles = std::ceil(job_.pixels / job_.tile_pixels);
    PassSizes sizes = passes(samples, records);
    double seconds = 0;
    for (std::uint32_t done = 0; done < all;) {
      const std::uint32_t pass = std::min(sizes.next(done, 0), all - done);
      const std::uint32_t unit = std::min(pass, sizes.unit(done));
      const double units = tiles * std::ceil(static_cast<double>(pass) / unit);
      seconds += std::ceil(units / (ranks_ * job_.threads)) * unit * job_.tile_pixels * path;
      done += pass;
    }
    return seconds;
  }

  /// Returns how many of all paths other ranks than the receiver have traced.
  double sent(double paths) const { return paths * (1 - 1 / ranks_); }

  double shared(double serial, double by_threads) const {
    return serial + by_threads / job_.threads;
  }

  /// Returns the time of the update after an iteration on one rank. Beyond the measured
  /// iterations, it grows as between the last two of them, at most in proportion to the paths.
  double update(double paths) const {
    const std::vector<double>& known = rates_.updates;
    const double place = std::log2(paths / rates_.first_paths);
    const double last = static_cast<double>(known.size()) - 1;
    double seconds = known[static_cast<std::size_t>(std::clamp(place, 0.0, last))];
    if (place > last) {
      const double growth = std::clamp(known.back() / known[known.size() - 2], 1.0, 2.0);
      seconds *= std::pow(growth, place - last);
    }
    const double threads = rates_.update_shared * seconds;
    return shared(seconds - threads, threads);
  }

  /// Returns the time to gather the guides, if they are not on rank 0, and to broadcast them.
  double exchange_of_guides() const {
    if (ranks_ == 1) return 0;
    // A long broadcast scatters the parts and then gathers them everywhere.
    const double broadcast = 2 * rates_.guide_bytes / job_.bandwidth;
    const double gather = owners_ > 1 ? rates_.guide_bytes / job_.bandwidth : 0;
    return broadcast + gather + 2 * job_.latency * std::log2(ranks_);
  }

  const ClusterRates& rates_;
  const ClusterJob& job_;
  double owners_, ranks_;
};

}  // namespace

double cluster_efficiency(const ClusterRates& rates, const ClusterJob& job, LearningPlace place,
                          double ranks) {
  return Simulation(rates, job, place, 1).run() /
         (ranks * Simulation(rates, job, place, ranks).run());
}

}  // namespace pharos::bench
