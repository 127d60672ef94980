#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "frequencies.h"
#include "point_set.h"

/// Synthesis of point sets by gradient descent after M. Werner, J. Hanika and C. Dachsbacher,
/// "Optimized and Aligned Anisotropic Monte Carlo Sampling Patterns", section 4.
namespace pharos::aligned {

inline constexpr std::uint32_t kFewestPoints = 1u << 6, kMostPoints = 1u << 16;

/// Whether sets of so many points can be made: powers of two from 2^6 to 2^16.
constexpr bool is_set_size(std::uint32_t points) {
  return points >= kFewestPoints && points <= kMostPoints && (points & (points - 1)) == 0;
}

/// What determines a set of points.
struct SynthesisSettings {
  std::uint32_t points = 4096;     ///< N, see is_set_size()
  std::vector<double> directions;  ///< of low energy, beside the axes [degrees]
  int steps = 400;                 ///< of gradient descent, >= 1
  /// Length of the first steps, in units of 1 / sqrt(N), the points' spacing; it falls to zero as
  /// half a period of a cosine does.
  double step = 0.1;
  double spectrum = 1;  ///< weight of the power spectrum loss, >= 0 (eq. 10)
  /// c, weight of the sliced Wasserstein loss, >= 0 (eq. 10). Of more than 4096 points it counts
  /// 4096 / N times: their spectrum could not fall further beside it.
  double wasserstein = 0.001;
  SuppressionRule rule;
  /// Where not empty: the frequencies of the power spectrum loss instead of those of the rule.
  std::vector<TargetPower> mask;
  std::uint64_t seed = 1;  ///< of the jittered grid that descent starts from

  friend bool operator==(const SynthesisSettings&, const SynthesisSettings&) = default;
};

/// Both losses at one time, without their weights.
struct LossRecord {
  double spectrum = 0;     ///< see PowerSpectrumLoss; 0 where its weight is zero
  double wasserstein = 0;  ///< see WassersteinLoss; 0 where its weight is zero
};

/// How a synthesis is watched and stopped.
struct SynthesisControl {
  /// Told the share of the work that is done, in [0, 1]. May be empty.
  std::function<void(double fraction)> on_progress;
  /// Set by anyone to end the work. May be null.
  const std::atomic<bool>* stop = nullptr;

  bool stopped() const { return stop != nullptr && *stop; }
};

struct Synthesis {
  PointSet points;                  ///< empty when it was stopped
  std::vector<LossRecord> history;  ///< before each step
  std::size_t frequencies = 0;      ///< of the power spectrum loss; 0 where its weight is zero
};

/// Makes a set of points: from a jittered grid of the seed, by Adam, down the gradient of
///
///     spectrum * L_spec + wasserstein * L_SW                      (eq. 10)
///
/// with the losses of power_spectrum_loss.h and wasserstein_loss.h, whose units do not depend on N.
/// The same settings give the same points for any number of threads, and with any compiler and
/// processor whose arithmetic follows IEEE 754. Throws InputError for numbers of points that no set
/// has, and where both weights are zero.
Synthesis synthesize(const SynthesisSettings& settings, const SynthesisControl& control = {});

/// What synthesize() starts from: a point at a random place of each cell of a grid that has as many
/// columns as rows, or twice as many. For tests and comparisons.
PointSet jittered_grid(std::uint32_t points, std::uint64_t seed);

}  // namespace pharos::aligned
