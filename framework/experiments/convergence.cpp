// Convergence curves of an experiment, and what follows from them.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <pharos/experiments/summary.h>

namespace pharos {
namespace {

/// One run's errors over its work, both as logarithms.
struct Track {
  std::vector<double> x, y;

  /// By straight lines between points; empty beyond the ends.
  std::optional<double> at(double log_x) const {
    const auto above = std::lower_bound(x.begin(), x.end(), log_x);
    if (above == x.end() || (above == x.begin() && *above != log_x)) return std::nullopt;
    const auto i = static_cast<std::size_t>(above - x.begin());
    if (*above == log_x) return y[i];
    const double t = (log_x - x[i - 1]) / (x[i] - x[i - 1]);
    return (1 - t) * y[i - 1] + t * y[i];
  }
};

struct Axis {
  const char* name;
  double Checkpoint::*member;
};
constexpr std::array<Axis, 2> kAxes{
    {{"samples", &Checkpoint::samples_per_pixel}, {"seconds", &Checkpoint::seconds}}};

Track track_of(const RunRecord& run, const Axis& axis, Metric metric) {
  Track track;
  for (const Checkpoint& checkpoint : run.checkpoints) {
    const double x = std::log(checkpoint.*axis.member), y = std::log(checkpoint.errors[metric]);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    if (!track.x.empty() && x <= track.x.back()) continue;
    track.x.push_back(x);
    track.y.push_back(y);
  }
  return track;
}

/// The mean of all tracks where the first has points and the others reach.
std::vector<ReportCurve::Point> mean_points(const std::vector<Track>& tracks) {
  std::vector<ReportCurve::Point> points;
  for (const double log_x : tracks.front().x) {
    std::vector<double> errors;
    for (const Track& track : tracks) {
      if (const auto log_y = track.at(log_x)) errors.push_back(std::exp(*log_y));
    }
    if (errors.size() < tracks.size()) continue;
    const statistics::Bounded mean = statistics::geometric_mean(errors);
    ReportCurve::Point point{std::exp(log_x), mean.value, {}};
    if (errors.size() > 1) point.interval = mean.interval;
    points.push_back(point);
  }
  return points;
}

void set_slope(const std::vector<Track>& tracks, ReportCurve& curve) {
  std::vector<double> slopes;
  for (const Track& track : tracks) {
    if (track.x.size() >= 3) slopes.push_back(statistics::fitted_slope(track.x, track.y).value);
  }
  if (slopes.empty()) return;
  const statistics::Bounded mean = statistics::arithmetic_mean(slopes);
  curve.slope = mean.value;
  if (slopes.size() > 1) curve.slope_interval = mean.interval;
}

/// The moment after which a curve stays at or below `target`; empty when it ends above it.
std::optional<double> time_below(const std::vector<ReportCurve::Point>& points, double target) {
  if (points.empty() || points.back().y > target) return std::nullopt;
  std::size_t i = points.size() - 1;
  while (i > 0 && points[i - 1].y <= target) --i;
  if (i == 0) return points.front().x;
  const ReportCurve::Point &a = points[i - 1], &b = points[i];
  const double t = std::log(a.y / target) / std::log(a.y / b.y);
  return a.x * std::pow(b.x / a.x, t);
}

const ReportCurve* find_curve(const std::vector<ReportCurve>& curves, const std::string& scene,
                              const std::string& method) {
  const std::string_view metric = metric_info(Metric::relative_mse).key;
  for (const ReportCurve& curve : curves) {
    if (curve.scene == scene && curve.method == method && curve.metric == metric &&
        curve.axis == "seconds") {
      return &curve;
    }
  }
  return nullptr;
}

}  // namespace

std::vector<ReportCurve> convergence_curves(const ExperimentResults& results) {
  std::vector<ReportCurve> curves;
  for (const PlannedCell& cell : results.plan.cells) {
    const std::string& scene = results.config.scenes[cell.scene].name;
    const std::string& method = results.config.methods[cell.method].name;
    for (const Metric metric : checkpoint_metrics()) {
      for (const Axis& axis : kAxes) {
        std::vector<Track> tracks;
        for (const RunRecord& run : results.records) {
          if (run.scene != scene || run.method != method) continue;
          tracks.push_back(track_of(run, axis, metric));
        }
        if (tracks.empty()) continue;
        ReportCurve curve{.scene = scene,
                          .method = method,
                          .metric = std::string(metric_info(metric).key),
                          .axis = axis.name,
                          .points = mean_points(tracks),
                          .slope = {},
                          .slope_interval = {}};
        set_slope(tracks, curve);
        if (!curve.points.empty()) curves.push_back(std::move(curve));
      }
    }
  }
  return curves;
}

ReportTable equal_error_table(const ExperimentResults& results,
                              const std::vector<ReportCurve>& curves) {
  ReportTable table{"seconds_to_equal_error",
                    "time to equal error",
                    "s",
                    "Seconds after which the method's mean relMSE stays below what the baseline's "
                    "has at its end, between checkpoints on logarithmic axes; none where it is not "
                    "reached",
                    Better::lower,
                    {}};
  for (const ExperimentScene& scene : results.config.scenes) {
    ReportTable::Row row{scene.name, {}};
    const ReportCurve* baseline = find_curve(curves, scene.name, results.config.baseline);
    for (const ExperimentMethod& method : results.config.methods) {
      ReportCell cell;
      const ReportCurve* curve = find_curve(curves, scene.name, method.name);
      if (baseline != nullptr && curve != nullptr) {
        const auto time = time_below(curve->points, baseline->points.back().y);
        const auto whole = time_below(baseline->points, baseline->points.back().y);
        if (time) cell.value = *time;
        if (time && whole) cell.ratio = *time / *whole;
      }
      row.cells.push_back(cell);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace pharos
