#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/version.h>
#include <pharos/experiments/tables/json_number.h>
#include <pharos/laboratory/laboratory_report.h>

namespace pharos::laboratory {
namespace {

using nlohmann::json;

/// The format version of results.json.
constexpr int kFormat = 1;

json interval_json(const Interval& interval) {
  return json::array({json_number<json>(interval.low), json_number<json>(interval.high)});
}

json slope_json(const std::optional<VarianceSlope>& slope) {
  if (!slope) return nullptr;
  return {{"value", slope->slope.value},
          {"interval", interval_json(slope->slope.interval)},
          {"misfit", json_number<json>(slope->misfit)}};
}

json points_json(const LaboratoryResults& results, std::size_t s, std::size_t i) {
  const std::optional<std::size_t> baseline = results.baseline();
  json points = json::array();
  for (std::size_t n = 0; n < results.numbers.size(); ++n) {
    const VarianceEstimate& variance = results.samplers[s].variances[i][n];
    json point{{"points", results.numbers[n]},
               {"variance", variance.value},
               {"interval", interval_json(variance.interval)},
               {"ratio", nullptr},
               {"ratio_interval", nullptr}};
    if (baseline && *baseline != s) {
      if (const auto over = ratio(variance, results.samplers[*baseline].variances[i][n])) {
        point["ratio"] = over->value;
        point["ratio_interval"] = interval_json(over->interval);
      }
    }
    points.push_back(std::move(point));
  }
  return points;
}

json curves_json(const LaboratoryResults& results) {
  json curves = json::array();
  for (std::size_t i = 0; i < results.config.integrands.size(); ++i) {
    for (std::size_t s = 0; s < results.samplers.size(); ++s) {
      curves.push_back({{"integrand", results.config.integrands[i].name},
                        {"sampler", results.config.samplers[s].name},
                        {"slope", slope_json(results.samplers[s].slopes[i])},
                        {"variances", points_json(results, s, i)}});
    }
  }
  return curves;
}

/// Returns the rows from the top: the power at frequencies from -max_frequency to max_frequency.
json spectrum_json(const Image& spectrum) {
  json rows = json::array();
  for (int y = 0; y < spectrum.height(); ++y) {
    const float* row = spectrum.pixel(0, y);
    rows.push_back(std::vector<float>(row, row + spectrum.width()));
  }
  return rows;
}

json results_json(const LaboratoryResults& results, const Report& report) {
  json node{{"format", kFormat},
            {"version", version()},
            {"title", results.config.title},
            {"baseline", results.config.baseline},
            {"complete", !results.stopped},
            {"config", results.config.resolved}};
  for (const auto& [name, value] : report.facts) node["facts"][name] = value;
  for (const NamedIntegrand& integrand : results.config.integrands) {
    node["integrands"][integrand.name] = {{"type", integrand.integrand->plugin_name()},
                                          {"mean", integrand.integrand->mean()}};
  }
  for (std::size_t s = 0; s < results.samplers.size(); ++s) {
    node["samplers"][results.config.samplers[s].name] = {
        {"type", results.config.samplers[s].sampler->plugin_name()},
        {"spectrum", spectrum_json(results.samplers[s].spectrum)}};
  }
  node["curves"] = curves_json(results);
  return node;
}

}  // namespace

void write_results(const LaboratoryResults& results) {
  const std::filesystem::path folder = results.config.output;
  const Report report = laboratory_report(results);
  write_text_atomically(folder / "results.json", results_json(results, report).dump() + "\n");
  write_text_atomically(folder / "variances.csv", variances_csv(results));
  write_report(report, folder / "report.html");
}

}  // namespace pharos::laboratory
