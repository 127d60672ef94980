#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/laboratory/laboratory_config.h>
#include <pharos/laboratory/variance.h>

/// The laboratory: how fast the estimates of integrals known in closed form converge with the
/// points of each sampler.
///
///     add_integrands(registry);
///     const LaboratoryConfig config = load_laboratory(path, {}, registry);
///     const FileLock lock = claim_folder(config.output, config.source);
///     const LaboratoryResults results = measure(config, control);
///     write_results(results);
///
/// Every realization is a set of its own, for each sampler and number of points too, shifted by a
/// random vector on the torus; all integrands see the same sets. Realizations come in groups, each
/// of one preparation of the sampler; intervals are those of groups. All numbers are the same for
/// any number of threads.
namespace pharos::laboratory {

/// How the work is watched and stopped.
struct LaboratoryControl {
  /// Share of the work done, in [0, 1], and seconds since its start; called by one thread at a
  /// time. May be empty.
  std::function<void(double fraction, double seconds)> on_progress;
  /// Set by anyone to end the work early; numbers of points that all samplers have are kept, and
  /// spectra that are whole.
  const std::atomic<bool>* stop = nullptr;
};

/// What is known of one sampler.
struct SamplerResults {
  /// By integrand, then by number of points.
  std::vector<std::vector<VarianceEstimate>> variances;
  /// By integrand; none where fewer than three numbers of the fitted range are done, or a variance
  /// is zero.
  std::vector<std::optional<VarianceSlope>> slopes;
  /// Mean power over toroidal frequencies, x to the right, y up, zero in the middle; the number of
  /// rows and columns is odd. Empty: not measured.
  Image spectrum;
};

struct LaboratoryResults {
  LaboratoryConfig config;
  std::vector<double> numbers;           ///< of points, ascending; all that are done
  std::vector<SamplerResults> samplers;  ///< in the order of the config
  double seconds = 0;
  bool stopped = false;  ///< something of the work is missing

  /// The place of the baseline among the samplers; none without one.
  std::optional<std::size_t> baseline() const;
};

/// Does all of a config's work.
LaboratoryResults measure(const LaboratoryConfig& config, const LaboratoryControl& control = {});

/// Writes results.json, variances.csv and report.html into the config's output folder, which must
/// exist (see claim_folder()), each whole or not at all. There must be results: at least one number
/// of points is done. Throws RunError when a file cannot be written.
void write_results(const LaboratoryResults& results);

/// Slopes, and ratios to the baseline at the largest number of points, a sampler a line.
std::string text_tables(const LaboratoryResults& results);

}  // namespace pharos::laboratory
