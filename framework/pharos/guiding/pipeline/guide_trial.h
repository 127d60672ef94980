#pragma once

#include <cstddef>
#include <cstdint>
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
  double path_cost = 1;  ///< time of a guided path over the time of an unguided one [1]; see
                         ///< IterationCost::steps
  bool is_off = false;   ///< neither suffices, see TrainingSettings: the image is not guided
};

/// The cost of a training iteration.
struct IterationCost {
  double spent = 0;    ///< share of the budget that is spent after it [1]
  double samples = 0;  ///< per pixel; 0: not known
  /// Mean number of steps of a path, if a rule is learned that ends and splits paths; otherwise 1.
  /// Such a rule changes the length of paths between iterations, with or without guides. Guides are
  /// therefore judged by the time of a step.
  double steps = 1;
  double seconds =
      0;  ///< of rendering them. Budgets of samples do not depend on it and leave it 0.
};

/// Puts the guides of a render on trial: measures how much they help, and decides when training
/// ends, which methods go on, and whether the image is guided.
///
/// Let q be the noise ratio times the time of a guided path over the time of an unguided one: in
/// the same time, guided paths make an image with q times the error. The time is measured by
/// training iterations with and without guides, or taken as 1.5 if the budget is a number of
/// samples. If a rule is learned that ends and splits paths, it is the time of a step: NoiseRatio
/// compares guided and unguided paths of the same rule.
///
/// Let training have spent the share s of the time, and let its next iteration take the share t. If
/// training ends, the rest of the time is worth (1 - s) / q times as much as the whole time without
/// guides, or 1 - s if they are off. In the same time, training makes about half as many samples as
/// the final image, because all guides are asked and learn (0.35 to 0.6 of them were measured). If
/// it goes on, the rest is worth t / 2q (nothing if the images of training are discarded) plus
/// (1 - s - t) / q', or plus 1 - s - t if the guides are off then. The noise falls less and less
/// from iteration to iteration: its logarithm is expected to fall from q to q' by half as much as
/// in the last iteration, or by half of what the gain has risen by, whichever is more.
///
/// Guides that do not suffice must promise more. Their gain counts only if it may rise to
/// TrainingSettings::least_gain, and then it counts in full. If it may not, the noise is expected
/// to fall by as much as in the last iteration and a standard error. After a single measurement, it
/// is expected to fall by e^-0.5. If unguided images hide the share h of the light, guides may find
/// it: after the first measurement the noise is expected to fall by 1 - h at least, and the
/// logarithm of this promise halves with every measurement.
///
/// The noise ratio was measured in the last iteration. The guides have learned since, so the
/// logarithm of the ratio of an image that is made now is expected to be lower, by half as much as
/// it fell in that iteration. Each of the two steps, to now and from now through the next
/// iteration, is half of the last fall that was measured.
class GuideTrial {
 public:
  GuideTrial(const TrainingSettings& settings, PixelRect window);

  /// Takes the recorded paths of one work unit. `is_guided`: guides could take part in them.
  void absorb(const PathLog& log, bool is_guided);
  /// Ends an iteration. Returns whether training may end, because the guides have settled or are
  /// not worth going on.
  bool end_iteration(const IterationCost& cost, bool is_guided);
  /// Returns the largest share of the budget that the next training iteration is worth [1]: all of
  /// it. If the guides may be useless, it is the rest of the share TrainingSettings::trial or half
  /// of that share, whichever is larger. As long as the gain is unknown, it is at least twice the
  /// share of the last iteration, because it takes more and more samples to find light. After the
  /// first iteration it is at least that iteration's share: nothing tells how long guides take.
  double worthwhile_share() const;
  /// Returns whether the guides do not help enough to be used. False as long as it is unknown.
  bool is_useless() const;
  /// Returns a method that the guides can do without: in the last two measurements of the gain it
  /// took part, and its part was less than TrainingSettings::least_part. Of several such methods it
  /// is the one with the smallest part. None if the last iteration has measured nothing, if no
  /// other method took part, on trial, and if the guides do not suffice.
  std::optional<std::size_t> dispensable_method() const;
  /// Returns how much the guides help, without a verdict; none if too few paths have
  /// found light to tell.
  std::optional<GuideGain> gain() const;

  void archive(Archive& archive) {
    archive(gain_, noise_, parts_before_, spent_before_, spent_, unguided_work_, unguided_seconds_,
            guided_seconds_, has_measured_, measurements_);
  }

 private:
  /// Returns the time of a guided path, or step, over the time of an unguided one [1].
  double path_cost() const;
  /// Returns q of an image that is made now; none if the noise ratio is unknown.
  std::optional<double> noise_in_time() const;
  /// Returns whether the next iteration would end nearer to TrainingSettings::trial.
  bool is_on_trial() const;
  bool lowers_noise() const;
  /// Returns whether the ratio of the last iteration, a standard error above, would suffice.
  bool surely_lowers_noise() const;
  bool may_be_useless() const;
  /// Returns by how much the logarithm of the noise may fall in the next iteration [nats].
  double possible_fall() const;
  /// Returns by how much it may fall if guides find the light that unguided images hide [nats].
  double promised_fall() const;
  /// Returns whether another iteration may be worth more than the time that it takes.
  bool may_pay() const;
  /// Returns the share of the budget that the next training iteration will probably take [1].
  double next_share() const;

  TrainingSettings settings_;
  HeldOutGain gain_;
  NoiseRatio noise_;
  std::vector<HeldOutGain::Part> parts_before_;  ///< of the measurement before the last
  double spent_before_ = 0, spent_ = 0;          ///< shares of the budget
  /// Samples per pixel, times IterationCost::steps, of iterations without guides, and their time.
  double unguided_work_ = 0, unguided_seconds_ = 0;
  double guided_seconds_ = 0;       ///< of as much work in the last guided iteration; 0: unknown
  bool has_measured_ = false;       ///< the last iteration has measured the gain
  std::uint32_t measurements_ = 0;  ///< of the gain, in all iterations so far
};

}  // namespace pharos
