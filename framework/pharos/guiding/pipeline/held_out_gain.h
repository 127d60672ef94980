#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Measures how much better guided sampling explains light than unguided sampling: the mean of
/// log(p / p_u) over the steps of paths, weighted by the contributions of the paths through them.
/// p is the density with which the step was drawn, p_u the density of unguided sampling. This is
/// the difference of the divergences of p_u and p from the distribution of the light [nats].
///
/// The models of an iteration have not learned from its paths, so the measure is held out. As long
/// as only a few paths have found light, nothing is measured, and the next iteration adds its paths
/// to them: chance would decide otherwise, and guides that have learned from so few paths have
/// hardly begun.
class HeldOutGain {
 public:
  /// Takes the recorded paths of one work unit. The units give the standard error.
  void absorb(const PathLog& log);

  /// Returns whether the iteration has measured the gain. If not, the last measurement stays.
  bool end_iteration();
  /// Returns whether the gain is less than `least`. False as long as nothing was measured. Here and
  /// below, the last measurement and the one before count.
  bool is_below(double least) const { return has_last_ && last_.mean < least; }
  /// Returns whether it is uncertain that the gain is at least `least`: it is not one standard
  /// error above, or nothing was measured.
  bool may_be_below(double least) const;
  /// Returns whether the gain may reach `least` in the next iteration: it is at least `least`, or a
  /// possible_rise() lifts it there. True as long as there is a single measurement, because the
  /// gain may rise from there.
  bool may_reach(double least) const {
    return last_.mean + std::max(0.0, possible_rise()) >= least;
  }
  /// Returns by how much the gain has risen [nats]; 0 if there are no two measurements.
  double rise() const { return has_before_ ? last_.mean - before_.mean : 0; }
  /// Returns by how much the gain may rise in the next iteration [nats]: by as much as before, and
  /// another standard error. Infinite as long as there are no two measurements.
  double possible_rise() const;
  /// Returns whether the gain was measured.
  bool is_known() const { return has_last_; }
  /// Returns the gain; 0 as long as nothing was measured.
  double value() const { return last_.mean; }
  /// The part of a method in the gain.
  struct Part {
    /// By how much the gain would have been less without the method, if its share had gone to all
    /// others in proportion [nats].
    double nats = 0;
    bool is_known = false;  ///< the method took part in paths that found light
    void archive(Archive& archive) { archive(nats, is_known); }
  };
  /// Returns the parts of the methods. Methods whose part is unknown may be missing at the end.
  std::span<const Part> parts() const { return last_parts_; }

  void archive(Archive& archive) {
    archive(sums_, last_, has_last_, before_, has_before_, parts_, last_parts_);
  }

 private:
  /// Least number of paths with light that measure a gain. In the scenes of this project, the first
  /// two guided samples per pixel find 8 or 28 where light is hardest to find, and thousands
  /// elsewhere.
  static constexpr std::uint64_t kFewest = 256;

  struct Sums {
    double weight = 0, log = 0;  ///< sums of w and of w log(p / p_u) over work units
    double weight_squared = 0, log_squared = 0, product = 0;
    std::uint64_t units = 0;
    std::uint64_t found = 0;  ///< number of paths that found light over guidable steps
    void archive(Archive& archive) {
      archive(weight, log, weight_squared, log_squared, product, units, found);
    }
  };
  struct Gain {
    double mean = 0, variance = 0;
    void archive(Archive& archive) { archive(mean, variance); }
  };
  /// Returns whether enough paths have found light since the last measurement.
  bool is_measured() const { return sums_.found >= kFewest && sums_.units > 1; }
  Gain gain() const;

  Sums sums_;           ///< since the last measurement
  Gain last_, before_;  ///< the last measurement and the one before
  bool has_last_ = false, has_before_ = false;
  std::vector<Part> parts_;  ///< sums of w log(p / p without the method), like `sums_`
  std::vector<Part> last_parts_;
  std::vector<Rgb> incident_;  ///< of one path; a member, so that it keeps its memory
};

}  // namespace pharos
