#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/version.h>
#include <pharos/experiments/metrics/summary.h>
#include <pharos/experiments/runner/results_files.h>
#include <pharos/experiments/tables/json_number.h>

namespace pharos {
namespace {

using nlohmann::json;

/// The format version of results.json.
constexpr int kFormat = 1;

/// Returns the shortest text that reads as the same number; empty if the value is unknown (NaN).
std::string csv_number(double value) {
  return std::isnan(value) ? "" : fmt::format("{}", value);
}

json reference_json(const Reference& reference) {
  json node{{"file", reference.file.string()}, {"key", reference.key}};
  if (reference.samples_per_pixel > 0) {
    node["samples_per_pixel"] = reference.samples_per_pixel;
    node["seconds"] = reference.seconds;
    node["version"] = reference.version;
    node["own_mse"] = json_number<json>(reference.mse);
    node["own_relative_mse"] = json_number<json>(reference.relative_mse);
  }
  return node;
}

json interval_json(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return json::array({json_number<json>(interval->low), json_number<json>(interval->high)});
}

json cell_json(const ReportCell& cell) {
  return {{"value", json_number<json>(cell.value)},
          {"interval", interval_json(cell.interval)},
          {"ratio", json_number<json>(cell.ratio)},
          {"ratio_interval", interval_json(cell.ratio_interval)}};
}

/// Returns cells in the nesting measure -> scene -> method -> cell.
json tables_json(const Report& report) {
  json tables = json::object();
  for (const ReportTable& table : report.tables) {
    json& node = tables[table.key];
    node["unit"] = table.unit;
    for (const ReportTable::Row& row : table.rows) {
      for (std::size_t m = 0; m < row.cells.size(); ++m) {
        node["scenes"][row.scene][report.methods[m]] = cell_json(row.cells[m]);
      }
    }
  }
  return tables;
}

json slopes_json(const Report& report) {
  json slopes = json::array();
  for (const ReportCurve& curve : report.curves) {
    slopes.push_back({{"scene", curve.scene},
                      {"method", curve.method},
                      {"metric", curve.metric},
                      {"axis", curve.axis},
                      {"slope", json_number<json>(curve.slope)},
                      {"interval", interval_json(curve.slope_interval)}});
  }
  return slopes;
}

json results_json(const ExperimentResults& results, const Report& report) {
  json node{{"format", kFormat},
            {"version", version()},
            {"title", results.config.title},
            {"baseline", results.config.baseline},
            {"complete", results.records.size() == results.run_count}};
  for (const auto& [name, value] : report.facts) node["facts"][name] = value;
  for (std::size_t s = 0; s < results.references.size(); ++s) {
    if (!results.references[s]) continue;
    node["references"][results.config.scenes[s].name] = reference_json(*results.references[s]);
  }
  for (const PlannedCell& cell : results.plan.cells) {
    node["configs"][results.config.scenes[cell.scene].name]
        [results.config.methods[cell.method].name] = cell.text;
  }
  for (const auto& [method, papers] : papers_by_method(results)) node["papers"][method] = papers;
  node["runs"] = json::array();
  for (const RunRecord& record : results.records) node["runs"].push_back(to_json(record));
  node["summary"] = tables_json(report);
  node["slopes"] = slopes_json(report);
  return node;
}

}  // namespace

std::map<std::string, std::set<std::string>> papers_by_method(const ExperimentResults& results) {
  std::map<std::string, std::set<std::string>> all;
  for (const PlannedCell& cell : results.plan.cells) {
    if (cell.papers.empty()) continue;
    all[results.config.methods[cell.method].name].insert(cell.papers.begin(), cell.papers.end());
  }
  return all;
}

std::string runs_csv(const ExperimentResults& results) {
  std::string text = "scene,method,seed,samples_per_pixel";
  for (const MetricInfo& info : metric_infos()) text += fmt::format(",{}", info.key);
  text +=
      ",invalid_pixels,invalid_paths,rays,gain,noise_ratio,guiding_is_off,model_bytes,"
      "seconds_preparation,seconds_sampler,seconds_training,seconds_update,"
      "seconds_rendering,peak_bytes,version\n";
  for (const RunRecord& run : results.records) {
    text += fmt::format("{},{},{},{}", run.scene, run.method, run.seed, run.samples_per_pixel);
    for (const MetricInfo& info : metric_infos()) text += "," + csv_number(run.errors[info.metric]);
    const GuideGain gain = run.gain.value_or(GuideGain{.nats = NAN});
    text += fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", run.errors.invalid_pixels,
                        run.invalid_paths, run.rays, csv_number(gain.nats),
                        csv_number(gain.noise_ratio.value_or(NAN)), gain.is_off ? 1 : 0,
                        run.model_bytes, run.times.preparation, run.times.sampler,
                        run.times.training, run.times.update, run.times.rendering,
                        csv_number(run.peak_bytes.value_or(NAN)), run.version);
  }
  return text;
}

std::string measures_csv(const ExperimentResults& results) {
  std::string text = "scene,method,seed,measure,unit,value\n";
  for (const RunRecord& run : results.records) {
    const auto add = [&](std::string_view measure, std::string_view unit, double value) {
      if (std::isnan(value)) return;
      text += fmt::format("{},{},{},{},{},{}\n", run.scene, run.method, run.seed, measure, unit,
                          csv_number(value));
    };
    for (const MetricInfo& info : metric_infos()) add(info.key, info.unit, run.errors[info.metric]);
    add("samples_per_pixel", "", run.samples_per_pixel);
    add("training_samples_per_pixel", "", run.training_samples);
    add("seconds", "s", run.seconds());
    add("rays", "", static_cast<double>(run.rays));
    add("model_bytes", "B", static_cast<double>(run.model_bytes));
    add("peak_bytes", "B", run.peak_bytes.value_or(NAN));
    if (run.gain) add("gain", "nat", run.gain->nats);
  }
  return text;
}

std::string convergence_csv(const ExperimentResults& results) {
  std::string text = "scene,method,seed,samples_per_pixel,seconds";
  for (const Metric metric : checkpoint_metrics()) {
    text += fmt::format(",{}", metric_info(metric).key);
  }
  text += "\n";
  for (const RunRecord& run : results.records) {
    for (const Checkpoint& checkpoint : run.checkpoints) {
      text += fmt::format("{},{},{},{},{}", run.scene, run.method, run.seed,
                          checkpoint.samples_per_pixel, checkpoint.seconds);
      for (const Metric metric : checkpoint_metrics()) {
        text += "," + csv_number(checkpoint.errors[metric]);
      }
      text += "\n";
    }
  }
  return text;
}

void write_results(const ExperimentResults& results) {
  const std::filesystem::path folder = results.folder();
  std::filesystem::create_directories(folder);
  const Report report = experiment_report(results);
  write_text_atomically(folder / "results.json", results_json(results, report).dump(1) + "\n");
  write_text_atomically(folder / "runs.csv", runs_csv(results));
  write_text_atomically(folder / "measures.csv", measures_csv(results));
  write_text_atomically(folder / "convergence.csv", convergence_csv(results));
  write_report(report, folder / "report.html");
}

}  // namespace pharos
