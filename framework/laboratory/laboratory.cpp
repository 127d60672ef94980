#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include <pharos/core/parallel.h>
#include <pharos/laboratory/laboratory.h>
#include <pharos/laboratory/point_stream.h>
#include <pharos/statistics/point_sets.h>

namespace pharos::laboratory {
namespace {

/// Estimates of all integrands, one vector each, by realisation.
using Estimates = std::vector<std::vector<double>>;

/// Sets are handed to threads in groups of about as many points.
constexpr std::uint64_t kPointsOfTask = 16384;

/// All work of one config, from the smallest number of points to the largest.
class Bench {
 public:
  Bench(const LaboratoryConfig& config, const LaboratoryControl& control)
      : config_(config), control_(control) {
    total_ = static_cast<double>(config.samplers.size()) * config.realisations *
             (std::exp2(config.samples.to + 1) - std::exp2(config.samples.from));
  }

  LaboratoryResults run() {
    LaboratoryResults results{.config = config_, .numbers = {}, .samplers = {}};
    results.samplers.resize(config_.samplers.size());
    for (SamplerResults& sampler : results.samplers) {
      sampler.variances.resize(config_.integrands.size());
    }
    for (std::uint32_t power = config_.samples.from; power <= config_.samples.to; ++power) {
      if (!add_number(power, results)) break;
      results.numbers.push_back(std::exp2(power));
    }
    if (!stops()) add_spectra(results);
    results.stopped = stops();
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
    done_ += points;
    if (control_.on_progress) control_.on_progress(done_ / total_, seconds());
  }

  /// Estimates from the sets of realisations `first` to `last` - 1.
  Estimates estimates_of(const PreparedSampler& prepared, std::uint32_t power, std::uint64_t first,
                         std::uint64_t last) const {
    Estimates estimates(config_.integrands.size());
    for (std::uint64_t r = first; r < last; ++r) {
      const std::vector<PlanePoint> points = shifted_point_set(prepared, {config_.seed, power, r});
      for (std::size_t i = 0; i < estimates.size(); ++i) {
        const double sum = config_.integrands[i].integrand->sum(points);
        estimates[i].push_back(sum / static_cast<double>(points.size()));
      }
    }
    return estimates;
  }

  /// All estimates of a sampler with 2^power points; none when stopped.
  std::optional<Estimates> all_estimates(const Sampler& sampler, std::uint32_t power) {
    const auto prepared = prepare(sampler, config_.seed, power);
    const std::uint64_t count = std::uint64_t{1} << power;
    const std::uint64_t group = std::max<std::uint64_t>(1, kPointsOfTask / count);
    const std::uint64_t groups = (config_.realisations + group - 1) / group;
    Estimates all(config_.integrands.size());
    const auto produce = [&](std::size_t g) {
      const std::uint64_t last = std::min<std::uint64_t>((g + 1) * group, config_.realisations);
      return estimates_of(*prepared, power, g * group, last);
    };
    const auto consume = [&](std::size_t, const Estimates& part) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].insert(all[i].end(), part[i].begin(), part[i].end());
      }
      report(static_cast<double>(part.front().size() * count));
    };
    parallel_ordered(groups, produce, consume, [this](std::size_t) { return !stops(); });
    if (all.front().size() < config_.realisations) return std::nullopt;
    return all;
  }

  /// Measures all samplers with 2^power points; false, and nothing is added, when stopped.
  bool add_number(std::uint32_t power, LaboratoryResults& results) {
    std::vector<Estimates> found;
    for (const NamedSampler& sampler : config_.samplers) {
      std::optional<Estimates> estimates = all_estimates(*sampler.sampler, power);
      if (!estimates) return false;
      found.push_back(std::move(*estimates));
    }
    for (std::size_t s = 0; s < found.size(); ++s) {
      for (std::size_t i = 0; i < found[s].size(); ++i) {
        results.samplers[s].variances[i].push_back(
            variance_about(config_.integrands[i].integrand->mean(), found[s][i]));
      }
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

  Image spectrum_of(const Sampler& sampler) const {
    const SpectrumSettings& s = config_.spectrum;
    const auto power = static_cast<std::uint32_t>(std::bit_width(s.points) - 1);
    const auto prepared = prepare(sampler, config_.seed, power);
    statistics::PowerSpectrum spectrum(s.max_frequency);
    for (std::uint64_t r = 0; r < s.realisations; ++r) {
      spectrum.add(point_set(*prepared, {config_.seed, power, r}));
    }
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

  void add_spectra(LaboratoryResults& results) const {
    if (config_.spectrum.points == 0) return;
    parallel_for(results.samplers.size(), [&](std::size_t i) {
      results.samplers[i].spectrum = spectrum_of(*config_.samplers[i].sampler);
    });
  }

  const LaboratoryConfig& config_;
  const LaboratoryControl& control_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double total_ = 0, done_ = 0;  ///< points
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
