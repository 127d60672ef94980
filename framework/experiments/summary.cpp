#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <pharos/experiments/summary.h>

namespace pharos {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What is told of a run.
struct RunMeasure {
  ReportTable head;  ///< without rows
  bool has_ratios;   ///< values are positive, and twice as much is as much again
  std::function<double(const RunRecord&)> value;
};

RunMeasure metric_measure(const MetricInfo& info) {
  const Metric metric = info.metric;
  return {{std::string(info.key),
           std::string(info.title),
           std::string(info.unit),
           std::string(info.definition),
           info.lower_is_better ? Better::lower : Better::higher,
           {}},
          info.has_ratios,
          [metric](const RunRecord& run) { return run.errors[metric]; }};
}

double mega(double value) {
  return value * 1e-6;
}

double mebi(double bytes) {
  return bytes / (1024 * 1024);
}

std::vector<RunMeasure> all_measures() {
  std::vector<RunMeasure> measures;
  for (const MetricInfo& info : metric_infos()) measures.push_back(metric_measure(info));
  const auto add = [&](const char* key, const char* title, const char* unit, const char* definition,
                       Better better, bool has_ratios,
                       std::function<double(const RunRecord&)> value) {
    measures.push_back({{key, title, unit, definition, better, {}}, has_ratios, std::move(value)});
  };
  using R = RunRecord;
  add("error_times_seconds", "relMSE x time", "s",
      "relMSE times the seconds it took: the inverse of efficiency", Better::lower, true,
      [](const R& r) { return r.errors[Metric::relative_mse] * r.seconds(); });
  add("seconds", "time", "s", "Wall-clock time of training, updates and rendering", Better::neither,
      true, [](const R& r) { return r.seconds(); });
  add("seconds_preparation", "preparation", "s",
      "Wall-clock time of acceleration structure and sampler, not counted in a budget",
      Better::lower, false, [](const R& r) { return r.times.preparation; });
  add("seconds_training", "training", "s", "Wall-clock time of rendering training iterations",
      Better::neither, false, [](const R& r) { return r.times.training; });
  add("seconds_update", "updates", "s", "Wall-clock time of the learners' updates", Better::lower,
      false, [](const R& r) { return r.times.update; });
  add("seconds_rendering", "rendering", "s", "Wall-clock time of rendering the final image",
      Better::neither, false, [](const R& r) { return r.times.rendering; });
  add("samples_per_pixel", "samples a pixel", "", "Training included", Better::neither, true,
      [](const R& r) { return r.samples_per_pixel; });
  add("rays", "rays", "millions", "Radiance and shadow rays", Better::neither, true,
      [](const R& r) { return mega(static_cast<double>(r.rays)); });
  add("rays_per_second", "rays a second", "millions/s", "Over training, updates and rendering",
      Better::higher, true,
      [](const R& r) { return mega(static_cast<double>(r.rays)) / r.seconds(); });
  add("model_bytes", "learned models", "MiB", "Size of the learned models in memory", Better::lower,
      false, [](const R& r) { return mebi(static_cast<double>(r.model_bytes)); });
  add("peak_bytes", "peak memory", "MiB", "The most memory that the process held during the run",
      Better::lower, true, [](const R& r) { return mebi(r.peak_bytes.value_or(kNone)); });
  return measures;
}

/// The runs of one method on one scene, by seed.
std::vector<const RunRecord*> runs_of(const ExperimentResults& results, const std::string& scene,
                                      const std::string& method) {
  std::vector<const RunRecord*> runs;
  for (const RunRecord& run : results.records) {
    if (run.scene == scene && run.method == method) runs.push_back(&run);
  }
  return runs;
}

bool all_positive(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double v) { return v > 0 && std::isfinite(v); });
}

/// The mean in the way of a measure; the interval only of several values.
void set_mean(const std::vector<double>& values, bool geometric, ReportCell& cell) {
  const statistics::Bounded mean =
      geometric ? statistics::geometric_mean(values) : statistics::arithmetic_mean(values);
  cell.value = mean.value;
  if (values.size() > 1) cell.interval = mean.interval;
}

void set_ratio(const std::vector<double>& values, const std::vector<double>& baseline,
               ReportCell& cell) {
  const statistics::Bounded ratio = statistics::mean_ratio(values, baseline);
  cell.ratio = ratio.value;
  if (values.size() > 1) cell.ratio_interval = ratio.interval;
}

ReportCell cell_of(const RunMeasure& measure, const std::vector<const RunRecord*>& runs,
                   const std::vector<const RunRecord*>& baseline) {
  std::vector<double> values, own, others;
  for (const RunRecord* run : runs) {
    values.push_back(measure.value(*run));
    for (const RunRecord* other : baseline) {
      if (other->seed != run->seed) continue;
      own.push_back(values.back());
      others.push_back(measure.value(*other));
    }
  }
  ReportCell cell;
  const bool known = !values.empty() && std::all_of(values.begin(), values.end(),
                                                    [](double v) { return std::isfinite(v); });
  if (!known) return cell;
  set_mean(values, measure.has_ratios && all_positive(values), cell);
  if (measure.has_ratios && !own.empty() && all_positive(own) && all_positive(others)) {
    set_ratio(own, others, cell);
  }
  return cell;
}

bool says_something(const ReportTable& table) {
  for (const ReportTable::Row& row : table.rows) {
    for (const ReportCell& cell : row.cells) {
      if (std::isfinite(cell.value) && cell.value != 0) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<ReportTable> summary_tables(const ExperimentResults& results) {
  std::vector<ReportTable> tables;
  for (RunMeasure& measure : all_measures()) {
    ReportTable table = std::move(measure.head);
    for (const ExperimentScene& scene : results.config.scenes) {
      const auto baseline = runs_of(results, scene.name, results.config.baseline);
      ReportTable::Row row{scene.name, {}};
      for (const ExperimentMethod& method : results.config.methods) {
        row.cells.push_back(cell_of(measure, runs_of(results, scene.name, method.name), baseline));
      }
      table.rows.push_back(std::move(row));
    }
    if (says_something(table)) tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace pharos
