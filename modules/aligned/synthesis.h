#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "frequencies.h"
#include "point_set.h"

/// Synthesis of point sets by gradient descent, after M. Werner, J. Hanika and C. Dachsbacher,
/// "Optimized and Aligned Anisotropic Monte Carlo Sampling Patterns", section 4.
namespace pharos::aligned {

inline constexpr std::uint32_t kFewestPoints = 1u << 6, kMostPoints = 1u << 16;

/// Returns whether sets of this many points can be made: powers of two from 2^6 to 2^16.
constexpr bool is_set_size(std::uint32_t points) {
  return points >= kFewestPoints && points <= kMostPoints && (points & (points - 1)) == 0;
}

/// The settings that determine a set of points.
struct SynthesisSettings {
  std::uint32_t points = 4096;     ///< number of points N; see is_set_size()
  std::vector<double> directions;  ///< directions of low energy in addition to the axes [degrees]
  int steps = 400;                 ///< number of gradient descent steps, >= 1
  /// Length of the first step, in units of 1 / sqrt(N), the spacing of the points. The step length
  /// falls to zero as half a period of a cosine.
  double step = 0.1;
  double spectrum = 1;  ///< weight of the power spectrum loss, >= 0 (eq. 10)
  /// Weight c of the sliced Wasserstein loss, >= 0 (eq. 10). For more than 4096 points, the weight
  /// is multiplied by 4096 / N. Otherwise, the spectrum of such sets could not fall further.
  double wasserstein = 0.001;
  SuppressionRule rule;
  /// If not empty, the frequencies of the power spectrum loss, used instead of the frequencies of
  /// the rule.
  std::vector<TargetPower> mask;
  std::uint64_t seed = 1;  ///< seed of the jittered grid from which descent starts

  friend bool operator==(const SynthesisSettings&, const SynthesisSettings&) = default;
};

/// The values of both losses at one step, without their weights.
struct LossRecord {
  double spectrum = 0;     ///< see PowerSpectrumLoss; 0 if its weight is zero
  double wasserstein = 0;  ///< see WassersteinLoss; 0 if its weight is zero
};

/// Progress and cancellation of a synthesis.
struct SynthesisControl {
  /// Receives the share of the work that is done, in [0, 1]. May be empty.
  std::function<void(double fraction)> on_progress;
  /// The synthesis stops when another thread sets this flag. May be null.
  const std::atomic<bool>* stop = nullptr;

  bool stopped() const { return stop != nullptr && *stop; }
};

struct Synthesis {
  PointSet points;                  ///< empty if the synthesis was stopped
  std::vector<LossRecord> history;  ///< losses before each step
  std::size_t frequencies = 0;      ///< number in the power spectrum loss; 0 if its weight is zero
};

/// Synthesizes a set of points. Starting from a jittered grid with the given seed, Adam descends
/// along the gradient of
///
///     spectrum * L_spec + wasserstein * L_SW                      (eq. 10)
///
/// with the losses of power_spectrum_loss.h and wasserstein_loss.h, whose units do not depend on N.
/// The same settings give the same points for any number of threads, and with any compiler and
/// processor whose arithmetic follows IEEE 754. Throws InputError if no set can have this number of
/// points, or if both weights are zero.
Synthesis synthesize(const SynthesisSettings& settings, const SynthesisControl& control = {});

/// Returns the points from which synthesize() starts: a random point in each cell of a grid that
/// has as many columns as rows, or twice as many. For tests and comparisons.
PointSet jittered_grid(std::uint32_t points, std::uint64_t seed);

}  // namespace pharos::aligned
