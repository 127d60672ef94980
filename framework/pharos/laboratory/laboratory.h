#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/laboratory/laboratory_config.h>
#include <pharos/laboratory/variance.h>

/// The laboratory: measures how fast the estimates of integrals known in closed form converge with
/// the points of each sampler.
///
///     add_integrands(registry);
///     const LaboratoryConfig config = load_laboratory(path, {}, registry);
///     const FileLock lock = claim_folder(config.output, config.source);
///     const LaboratoryResults results = measure(config, control);
///     write_results(results);
///
/// Every realization has its own point set, for each sampler and number of points, shifted by a
/// random vector on the torus. All integrands use the same sets. Realizations form groups that
/// share one preparation of the sampler, and intervals are estimated from groups. All numbers are
/// the same for any number of threads.
namespace pharos::laboratory {

/// Callbacks that observe and stop the work.
struct LaboratoryControl {
  /// Receives the fraction of the work done, in [0, 1], and the seconds since its start. Called by
  /// one thread at a time. May be empty.
  std::function<void(double fraction, double seconds)> on_progress;
  /// Ends the work early when set, by any thread. The results keep those numbers of points that all
  /// samplers have, and the spectra that are complete.
  const std::atomic<bool>* stop = nullptr;
};

/// The results of one sampler.
struct SamplerResults {
  /// Variances by integrand, then by number of points.
  std::vector<std::vector<VarianceEstimate>> variances;
  /// Slopes by integrand; empty if fewer than three numbers of the fitted range are done, or if a
  /// variance is zero.
  std::vector<std::optional<VarianceSlope>> slopes;
  /// Mean power over toroidal frequencies, x to the right, y up, frequency zero in the middle. The
  /// number of rows and columns is odd. Empty if it was not measured.
  Image spectrum;
};

struct LaboratoryResults {
  LaboratoryConfig config;
  std::vector<double> numbers;           ///< all finished numbers of points, ascending
  std::vector<SamplerResults> samplers;  ///< in the order of the config
  double seconds = 0;
  bool stopped = false;  ///< part of the work is missing

  /// Returns the index of the baseline among the samplers; empty if there is no baseline.
  std::optional<std::size_t> baseline() const;
};

/// Measures everything that a config asks for.
LaboratoryResults measure(const LaboratoryConfig& config, const LaboratoryControl& control = {});

/// Writes results.json, variances.csv and report.html into the config's output folder, which must
/// exist (see claim_folder()). Each file is written completely or not at all. At least one number
/// of points must be finished. Throws RunError if a file cannot be written.
void write_results(const LaboratoryResults& results);

/// Returns slopes, and ratios to the baseline at the largest number of points, as text with one
/// line per sampler.
std::string text_tables(const LaboratoryResults& results);

}  // namespace pharos::laboratory
