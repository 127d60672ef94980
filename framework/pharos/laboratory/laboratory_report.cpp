#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <pharos/core/version.h>
#include <pharos/experiments/runner/machine.h>
#include <pharos/laboratory/laboratory_report.h>

namespace pharos::laboratory {
namespace {

constexpr const char* kVariance = "variance";

/// Describes which results are missing after an interruption.
std::string missing_text(const LaboratoryResults& results) {
  const PowerRange& range = results.config.samples;
  if (results.numbers.size() < range.to + 1 - range.from) {
    return fmt::format("interrupted before more than {:.0f} points", results.numbers.back());
  }
  return "interrupted before all power spectra; variances and slopes are complete";
}

std::vector<std::pair<std::string, std::string>> facts_of(const LaboratoryResults& results) {
  const LaboratoryConfig& config = results.config;
  std::vector<std::pair<std::string, std::string>> facts{
      {"Numbers of points", fmt::format("2^{} to 2^{}", config.samples.from, config.samples.to)},
      {"Slopes fitted", fmt::format("2^{} to 2^{}", config.fitted().from, config.fitted().to)},
      {"Realizations", std::to_string(config.realizations)},
      {"Preparations", std::to_string(config.groups())},
      {"Seed", std::to_string(config.seed)},
      {"Baseline", config.baseline.empty() ? "none" : config.baseline},
      {"Pharos", version()},
      {"Threads", std::to_string(thread_count())}};
  if (const std::string name = processor_name(); !name.empty())
    facts.emplace_back("Processor", name);
  facts.emplace_back("Time", fmt::format("{:.1f} s", results.seconds));
  facts.emplace_back("Written",
                     fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
  if (results.stopped) facts.emplace_back("Incomplete", missing_text(results));
  return facts;
}

ReportTable slope_table(const LaboratoryResults& results) {
  ReportTable table{
      "slope",
      "slope",
      "",
      "Slope of the straight line through log variance over log number of points: -1 for "
      "independent points",
      Better::lower,
      {}};
  for (std::size_t i = 0; i < results.config.integrands.size(); ++i) {
    ReportTable::Row row{results.config.integrands[i].name, {}};
    for (const SamplerResults& sampler : results.samplers) {
      ReportCell cell;
      if (const auto& slope = sampler.slopes[i]) {
        cell.value = slope->slope.value;
        cell.interval = slope->slope.interval;
      }
      row.cells.push_back(cell);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportCell variance_cell(const VarianceEstimate& variance, const VarianceEstimate* baseline) {
  ReportCell cell{.value = variance.value, .interval = variance.interval};
  if (baseline == nullptr) return cell;
  if (const auto over = ratio(variance, *baseline)) {
    cell.ratio = over->value;
    cell.ratio_interval = over->interval;
  }
  return cell;
}

/// Returns the variances at the largest number of points.
ReportTable variance_table(const LaboratoryResults& results) {
  ReportTable table{kVariance,
                    "variance",
                    "",
                    fmt::format("Variance of the estimate with {:.0f} points about the exact value",
                                results.numbers.back()),
                    Better::lower,
                    {}};
  const std::optional<std::size_t> baseline = results.baseline();
  for (std::size_t i = 0; i < results.config.integrands.size(); ++i) {
    ReportTable::Row row{results.config.integrands[i].name, {}};
    for (std::size_t s = 0; s < results.samplers.size(); ++s) {
      const bool has_ratio = baseline && *baseline != s;
      row.cells.push_back(
          variance_cell(results.samplers[s].variances[i].back(),
                        has_ratio ? &results.samplers[*baseline].variances[i].back() : nullptr));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportCurve curve_of(const LaboratoryResults& results, std::size_t s, std::size_t i) {
  ReportCurve curve{.scene = results.config.integrands[i].name,
                    .method = results.config.samplers[s].name,
                    .metric = kVariance,
                    .axis = "points",
                    .points = {},
                    .slope = {},
                    .slope_interval = {}};
  for (std::size_t n = 0; n < results.numbers.size(); ++n) {
    const VarianceEstimate& variance = results.samplers[s].variances[i][n];
    curve.points.push_back({results.numbers[n], variance.value, variance.interval});
  }
  if (const auto& slope = results.samplers[s].slopes[i]) {
    curve.slope = slope->slope.value;
    curve.slope_interval = slope->slope.interval;
  }
  return curve;
}

/// Returns all pictures as one group. The page uses the group's name as its heading.
ReportScene spectra_of(const LaboratoryResults& results) {
  const SpectrumSettings& s = results.config.spectrum;
  ReportScene scene{.name = fmt::format("Power spectra of {} points, {} realizations, {} cycles to "
                                        "each side",
                                        s.points, s.realizations, s.max_frequency),
                    .note = "",
                    .images = {},
                    .pictures = {}};
  for (std::size_t i = 0; i < results.samplers.size(); ++i) {
    if (results.samplers[i].spectrum.empty()) continue;
    scene.pictures.push_back({results.config.samplers[i].name, results.samplers[i].spectrum});
  }
  return scene;
}

}  // namespace

std::string variances_csv(const LaboratoryResults& results) {
  std::string text = "integrand,sampler,points,variance,low,high\n";
  for (std::size_t i = 0; i < results.config.integrands.size(); ++i) {
    for (std::size_t s = 0; s < results.samplers.size(); ++s) {
      for (std::size_t n = 0; n < results.numbers.size(); ++n) {
        const VarianceEstimate& v = results.samplers[s].variances[i][n];
        text += fmt::format("{},{},{:.0f},{},{},{}\n", results.config.integrands[i].name,
                            results.config.samplers[s].name, results.numbers[n], v.value,
                            v.interval.low, v.interval.high);
      }
    }
  }
  return text;
}

Report laboratory_report(const LaboratoryResults& results) {
  Report report;
  report.title = results.config.title;
  report.description = results.config.description;
  report.subject = "integrand";
  report.facts = facts_of(results);
  report.baseline = results.config.baseline;
  for (const NamedSampler& sampler : results.config.samplers) {
    report.methods.push_back(sampler.name);
  }
  report.tables = {slope_table(results), variance_table(results)};
  for (std::size_t i = 0; i < results.config.integrands.size(); ++i) {
    for (std::size_t s = 0; s < results.samplers.size(); ++s) {
      report.curves.push_back(curve_of(results, s, i));
    }
  }
  if (ReportScene spectra = spectra_of(results); !spectra.pictures.empty()) {
    report.scenes.push_back(std::move(spectra));
  }
  report.texts.push_back({"variances.csv", variances_csv(results)});
  report.texts.push_back({"config.yaml", results.config.resolved});
  return report;
}

}  // namespace pharos::laboratory
