#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <pharos/core/pixel_rect.h>
#include <pharos/guiding/pipeline/held_out_gain.h>
#include <pharos/guiding/pipeline/noise_ratio.h>
#include <pharos/guiding/pipeline/training_settings.h>

namespace pharos {

/// How much the guides help.
struct GuideGain {
  double nats = 0;  ///< gain in the last training iteration, see HeldOutGain
  /// Mean squared error of guided images over the error of unguided ones [1], see NoiseRatio.
  std::optional<double> noise_ratio;
  bool is_off = false;  ///< neither suffices, see TrainingSettings: the image is not guided
};

/// Puts the guides of a render on trial: measures how much they help, and decides when training
/// ends, which methods go on, and whether the image is guided.
///
/// Let training have spent the share s of the time, and let its next iteration take the share t. In
/// the same time, training makes about half as many samples as the final image, because all guides
/// are asked and learn (0.35 to 0.6 of them were measured). If training ends, 1 - s samples follow
/// (in units of the final image's samples in the whole time). If it goes on, t / 2 samples follow
/// that are as noisy (none if the images of training are discarded), and 1 - s - t that are less
/// noisy. So it pays if the noise falls by a factor below (1 - s - t) / (1 - s - t / 2). The noise
/// is expected to fall by as much as in the last iteration, or by e^-g if the gain has risen by g.
/// A budget of samples stands for time here.
class GuideTrial {
 public:
  GuideTrial(const TrainingSettings& settings, PixelRect window);

  /// Takes the recorded paths of one work unit. `is_guided`: guides could take part in them.
  void absorb(const PathLog& log, bool is_guided);
  /// Ends an iteration. `spent` is the share of the budget that was spent. Returns whether training
  /// may end, because the guides have settled or are not worth going on.
  bool end_iteration(double spent, bool is_guided);
  /// Returns the largest share of the budget that the next training iteration is worth [1]: all of
  /// it. If the guides may be useless, it is the rest of the share TrainingSettings::trial or half
  /// of that share, whichever is larger.
  double worthwhile_share() const;
  /// Returns whether the guides do not help enough to be used. False as long as it is unknown.
  bool is_useless() const;
  /// Returns a method that the guides can do without: in the last two iterations it took part, and
  /// its part in the gain was less than TrainingSettings::least_part. Of several such methods it is
  /// the one with the smallest part. None if no other method took part, before the share `trial` of
  /// the budget was spent, and if the guides do not suffice.
  std::optional<std::size_t> dispensable_method() const;
  /// Returns how much the guides help, without a verdict; none if no guided iteration found light.
  std::optional<GuideGain> gain() const;

  void archive(Archive& archive) { archive(gain_, noise_, parts_before_, spent_before_, spent_); }

 private:
  bool lowers_noise() const;
  bool may_be_useless() const;
  /// Returns whether the guides may suffice after another iteration like the last one.
  bool may_suffice() const;
  /// Returns whether another iteration may lower the noise by more than it costs.
  bool may_pay() const;
  /// Returns the share of the budget that the next training iteration will probably take [1].
  double next_share() const;

  TrainingSettings settings_;
  HeldOutGain gain_;
  NoiseRatio noise_;
  std::vector<HeldOutGain::Part> parts_before_;  ///< in the iteration before the last
  double spent_before_ = 0, spent_ = 0;          ///< shares of the budget
};

}  // namespace pharos
