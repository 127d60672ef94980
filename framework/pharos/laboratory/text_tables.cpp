#include <functional>

#include <fmt/format.h>

#include <pharos/experiments/tables/text_table.h>
#include <pharos/laboratory/laboratory.h>

namespace pharos::laboratory {
namespace {

/// Returns a table with samplers as rows and integrands as columns.
std::string table_of(const LaboratoryResults& results,
                     const std::function<std::string(std::size_t s, std::size_t i)>& cell) {
  std::vector<TextRow> rows{{"sampler"}};
  for (const NamedIntegrand& integrand : results.config.integrands) {
    rows[0].push_back(integrand.name);
  }
  for (std::size_t s = 0; s < results.samplers.size(); ++s) {
    TextRow row{results.config.samplers[s].name};
    for (std::size_t i = 0; i < results.config.integrands.size(); ++i) row.push_back(cell(s, i));
    rows.push_back(std::move(row));
  }
  return aligned(rows);
}

std::string slope_text(const std::optional<VarianceSlope>& slope) {
  if (!slope) return "-";
  const statistics::Bounded& s = slope->slope;
  return fmt::format("{:.3f} ±{:.3f}", s.value, 0.5 * (s.interval.high - s.interval.low));
}

std::string variance_text(const VarianceEstimate& variance, const VarianceEstimate* baseline) {
  if (baseline == nullptr) return fmt::format("{:.3g}", variance.value);
  const auto over = ratio(variance, *baseline);
  return over ? fmt::format("{:.3g}", over->value) : "-";
}

}  // namespace

std::string text_tables(const LaboratoryResults& results) {
  if (results.numbers.empty()) return "";
  const PowerRange range = results.config.fitted();
  std::string text = fmt::format(
      "slope of log variance over log number of points, 2^{} to 2^{}, with 95 % intervals\n",
      range.from, range.to);
  text += table_of(results, [&](std::size_t s, std::size_t i) {
    return slope_text(results.samplers[s].slopes[i]);
  });
  const std::optional<std::size_t> baseline = results.baseline();
  text += fmt::format("\nvariance at {:.0f} points{}\n", results.numbers.back(),
                      baseline ? " over that of '" + results.config.baseline + "'" : "");
  text += table_of(results, [&](std::size_t s, std::size_t i) {
    return variance_text(results.samplers[s].variances[i].back(),
                         baseline ? &results.samplers[*baseline].variances[i].back() : nullptr);
  });
  return text;
}

}  // namespace pharos::laboratory
