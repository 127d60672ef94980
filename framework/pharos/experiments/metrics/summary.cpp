#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <pharos/experiments/metrics/seed_means.h>
#include <pharos/experiments/metrics/summary.h>

namespace pharos {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A measure of runs and its table.
struct RunMeasure {
  ReportTable head;  ///< the table without rows
  bool has_ratios;   ///< values are positive and their ratios are meaningful
  bool is_error;     ///< also shown if all values are zero
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
          true,
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
    measures.push_back(
        {{key, title, unit, definition, better, {}}, has_ratios, false, std::move(value)});
  };
  using R = RunRecord;
  add("invalid_pixels", "invalid pixels", "", "Pixels of NaN or infinite value, left out of errors",
      Better::lower, false,
      [](const R& r) { return static_cast<double>(r.errors.invalid_pixels); });
  add("invalid_paths", "invalid paths", "", "Paths of NaN or infinite value, which count as black",
      Better::lower, false, [](const R& r) { return static_cast<double>(r.invalid_paths); });
  add("error_times_seconds", "relMSE x time", "s",
      "relMSE times the seconds it took: the inverse of efficiency", Better::lower, true,
      [](const R& r) { return r.errors[Metric::relative_mse] * r.seconds(); });
  add("seconds", "time", "s", "Wall-clock time of what a budget counts: all but the preparation",
      Better::neither, true, [](const R& r) { return r.seconds(); });
  add("seconds_preparation", "preparation", "s",
      "Wall-clock time of building the acceleration structure, not counted in a budget",
      Better::lower, false, [](const R& r) { return r.times.preparation; });
  add("seconds_sampler", "sampler", "s",
      "Wall-clock time that the sampler took to prepare itself: tables, looks at the integrand",
      Better::lower, false, [](const R& r) { return r.times.sampler; });
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
  add("gain", "gain of the guides", "nats",
      "How much better the guides explained the light of the last training iteration than unguided "
      "sampling does, a step of a path",
      Better::neither, false, [](const R& r) { return r.gain ? r.gain->nats : kNone; });
  add("noise_ratio", "noise of guided paths", "",
      "Mean squared error of an image of the guided paths of the last training iteration, over "
      "that "
      "of as many unguided paths, estimated from the guided paths",
      Better::neither, false,
      [](const R& r) { return r.gain ? r.gain->noise_ratio.value_or(kNone) : kNone; });
  add("model_bytes", "learned models", "MiB", "Size of the learned models in memory", Better::lower,
      false, [](const R& r) { return mebi(static_cast<double>(r.model_bytes)); });
  add("peak_bytes", "peak memory", "MiB", "The most memory that the process held during the run",
      Better::lower, true, [](const R& r) { return mebi(r.peak_bytes.value_or(kNone)); });
  return measures;
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
    const auto value = [&](const RunRecord& run, const RunRecord*) { return measure.value(run); };
    for (const ExperimentScene& scene : results.config.scenes) {
      table.rows.push_back(row_over_seeds(results, scene.name, measure.has_ratios, value));
    }
    if (measure.is_error || says_something(table)) tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace pharos
