#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/sampled_points.h>
#include <pharos/laboratory/laboratory.h>
#include <pharos/laboratory/point_stream.h>

namespace pharos::laboratory {
namespace {

/// Estimates of all integrands: one vector per integrand, ordered by realization.
using Estimates = std::vector<std::vector<double>>;

/// Evaluating the integrands at a point takes about as long as adding the point to this number of
/// frequencies of a spectrum.
constexpr double kFrequenciesOfPoint = 50;

/// All work of one config, from the smallest number of points to the largest, followed by the
/// spectra.
class Bench {
 public:
  Bench(const LaboratoryConfig& config, const LaboratoryControl& control)
      : config_(config), control_(control) {
    total_ = static_cast<double>(config.samplers.size()) * config.realizations *
             (std::exp2(config.samples.to + 1) - std::exp2(config.samples.from));
    total_ += static_cast<double>(config.samplers.size()) * config.spectrum.realizations *
              spectrum_work();
  }

  LaboratoryResults run() {
    LaboratoryResults results{.config = config_, .numbers = {}, .samplers = {}};
    results.samplers.resize(config_.samplers.size());
    for (SamplerResults& sampler : results.samplers) {
      sampler.variances.resize(config_.integrands.size());
    }
    results.stopped = !add_numbers(results) || !add_spectra(results);
    add_slopes(results);
    results.seconds = seconds();
    return results;
  }

 private:
  bool stops() const { return control_.stop != nullptr && *control_.stop; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  void report(double points) {
    const std::scoped_lock lock(progress_);
    done_ += points;
    if (control_.on_progress) control_.on_progress(done_ / total_, seconds());
  }

  /// Returns the work of one realization of a spectrum, in units of evaluated points.
  double spectrum_work() const {
    const double edge = 2.0 * config_.spectrum.max_frequency + 1;
    return config_.spectrum.points * edge * edge / 2 / kFrequenciesOfPoint;
  }

  /// Returns the estimates from the sets of one preparation; fewer if the work was stopped.
  Estimates estimates_of(const NamedSampler& sampler, std::uint32_t power, std::size_t group) {
    const std::uint64_t seed = seed_of(config_.seed, sampler.name);
    const auto prepared = prepare(*sampler.sampler, {seed, power, group});
    const std::size_t count = config_.realizations, groups = config_.groups();
    Estimates estimates(config_.integrands.size());
    for (std::size_t r = group_begin(group, groups, count);
         r < group_begin(group + 1, groups, count) && !stops(); ++r) {
      const std::vector<PlanePoint> points = shifted_point_set(*prepared, {seed, power, r});
      for (std::size_t i = 0; i < estimates.size(); ++i) {
        const double sum = config_.integrands[i].integrand->sum(points);
        estimates[i].push_back(sum / static_cast<double>(points.size()));
      }
      report(static_cast<double>(points.size()));
    }
    return estimates;
  }

  /// Returns all estimates of a sampler with 2^power points; empty if the work was stopped.
  std::optional<Estimates> all_estimates(const NamedSampler& sampler, std::uint32_t power) {
    Estimates all(config_.integrands.size());
    const auto produce = [&](std::size_t group) { return estimates_of(sampler, power, group); };
    const auto consume = [&](std::size_t, const Estimates& part) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].insert(all[i].end(), part[i].begin(), part[i].end());
      }
    };
    parallel_ordered(config_.groups(), produce, consume, [this](std::size_t) { return !stops(); });
    if (all.front().size() < config_.realizations) return std::nullopt;
    return all;
  }

  /// Measures all samplers with 2^power points. Returns false, and adds nothing, if the work was
  /// stopped.
  bool add_number(std::uint32_t power, LaboratoryResults& results) {
    std::vector<Estimates> found;
    for (const NamedSampler& sampler : config_.samplers) {
      std::optional<Estimates> estimates = all_estimates(sampler, power);
      if (!estimates) return false;
      found.push_back(std::move(*estimates));
    }
    for (std::size_t s = 0; s < found.size(); ++s) {
      for (std::size_t i = 0; i < found[s].size(); ++i) {
        results.samplers[s].variances[i].push_back(
            variance_about(config_.integrands[i].integrand->mean(), found[s][i], config_.groups()));
      }
    }
    results.numbers.push_back(std::exp2(power));
    return true;
  }

  /// Returns false if the work was stopped before the last number of points.
  bool add_numbers(LaboratoryResults& results) {
    for (std::uint32_t power = config_.samples.from; power <= config_.samples.to; ++power) {
      if (!add_number(power, results)) return false;
    }
    return true;
  }

  void add_slopes(LaboratoryResults& results) const {
    const PowerRange range = config_.fitted();
    const std::size_t first = range.from - config_.samples.from;
    const std::size_t end =
        std::min<std::size_t>(range.to + 1 - config_.samples.from, results.numbers.size());
    for (SamplerResults& sampler : results.samplers) {
      for (const std::vector<VarianceEstimate>& variances : sampler.variances) {
        sampler.slopes.emplace_back();
        if (end < first + 3) continue;
        sampler.slopes.back() = fitted_slope(std::span(results.numbers).subspan(first, end - first),
                                             std::span(variances).subspan(first, end - first));
      }
    }
  }

  /// Returns the spectrum of a sampler; empty if the work was stopped.
  Image spectrum_of(const NamedSampler& sampler) {
    const SpectrumSettings& s = config_.spectrum;
    const SpectrumPlan plan{.dimension = kDimension,
                            .count = s.points,
                            .realizations = static_cast<int>(s.realizations),
                            .max_frequency = s.max_frequency,
                            .seed = seed_of(config_.seed, sampler.name)};
    const statistics::PowerSpectrum spectrum = expected_spectrum(*sampler.sampler, plan, [this] {
      report(spectrum_work());
      return !stops();
    });
    if (spectrum.count() < s.realizations) return {};
    report(spectrum_work());
    const int edge = 2 * s.max_frequency + 1;
    Image image(edge, edge, {"Y"});
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        *image.pixel(x, y) =
            static_cast<float>(spectrum.at(x - s.max_frequency, s.max_frequency - y));
      }
    }
    return image;
  }

  /// Returns false if the work was stopped before all spectra were made.
  bool add_spectra(LaboratoryResults& results) {
    if (config_.spectrum.points == 0) return true;
    parallel_for(results.samplers.size(), [&](std::size_t i) {
      results.samplers[i].spectrum = spectrum_of(config_.samplers[i]);
    });
    return std::none_of(results.samplers.begin(), results.samplers.end(),
                        [](const SamplerResults& s) { return s.spectrum.empty(); });
  }

  const LaboratoryConfig& config_;
  const LaboratoryControl& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double total_ = 0;  ///< total work [points]
  std::mutex progress_;
  double done_ = 0;  ///< finished work [points], guarded by `progress_`
};

}  // namespace

std::optional<std::size_t> LaboratoryResults::baseline() const {
  for (std::size_t s = 0; s < config.samplers.size(); ++s) {
    if (config.samplers[s].name == config.baseline) return s;
  }
  return std::nullopt;
}

LaboratoryResults measure(const LaboratoryConfig& config, const LaboratoryControl& control) {
  return Bench(config, control).run();
}

}  // namespace pharos::laboratory
