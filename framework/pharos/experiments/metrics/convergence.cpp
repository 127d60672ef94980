// Convergence curves of an experiment, and the times to equal error.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <pharos/experiments/metrics/seed_means.h>
#include <pharos/experiments/metrics/summary.h>

namespace pharos {
namespace {

/// The errors of one run over its work, both as logarithms.
struct Track {
  std::vector<double> x, y;

  /// Interpolates linearly between points; empty beyond the ends.
  std::optional<double> at(double log_x) const {
    const auto above = std::lower_bound(x.begin(), x.end(), log_x);
    if (above == x.end() || (above == x.begin() && *above != log_x)) return std::nullopt;
    const auto i = static_cast<std::size_t>(above - x.begin());
    if (*above == log_x) return y[i];
    const double t = (log_x - x[i - 1]) / (x[i] - x[i - 1]);
    return (1 - t) * y[i - 1] + t * y[i];
  }
};

/// The horizontal axis of a curve.
struct Axis {
  const char* name;
  double Checkpoint::*member;
  double (*training)(const RunRecord&);  ///< the part of the work that training took
};
constexpr std::array<Axis, 2> kAxes{{{"samples", &Checkpoint::samples_per_pixel,
                                      [](const RunRecord& run) { return run.training_samples; }},
                                     {"seconds", &Checkpoint::seconds, [](const RunRecord& run) {
                                        return run.times.training + run.times.update;
                                      }}}};

/// Returns a run's errors over its work minus `offset`.
Track track_of(const RunRecord& run, const Axis& axis, Metric metric, double offset) {
  Track track;
  for (const Checkpoint& checkpoint : run.checkpoints) {
    const double x = std::log(checkpoint.*axis.member - offset);
    const double y = std::log(checkpoint.errors[metric]);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    if (!track.x.empty() && x <= track.x.back()) continue;
    track.x.push_back(x);
    track.y.push_back(y);
  }
  return track;
}

/// Returns the positions of the points of the mean curve of several tracks. They reach from where
/// all tracks have begun to where the first one ends. In between are the points of the first track
/// that are not close to either end.
std::vector<double> common_grid(const std::vector<Track>& tracks) {
  constexpr double kNext = 0.1;  // difference of logarithms
  double low = tracks.front().x.front(), high = tracks.front().x.back();
  for (const Track& track : tracks) {
    low = std::max(low, track.x.front());
    high = std::min(high, track.x.back());
  }
  if (low > high) return {};
  std::vector<double> grid{low};
  for (const double x : tracks.front().x) {
    if (x > low + kNext && x < high - kNext) grid.push_back(x);
  }
  if (high > low) grid.push_back(high);
  return grid;
}

std::vector<ReportCurve::Point> mean_points(const std::vector<Track>& tracks) {
  std::vector<ReportCurve::Point> points;
  for (const double log_x : common_grid(tracks)) {
    std::vector<double> errors;
    for (const Track& track : tracks) errors.push_back(std::exp(*track.at(log_x)));
    const statistics::Bounded mean = statistics::geometric_mean(errors);
    ReportCurve::Point point{std::exp(log_x), mean.value, {}};
    if (errors.size() > 1) point.interval = mean.interval;
    points.push_back(point);
  }
  return points;
}

/// Returns the slope of a run's errors over the work of its final image.
std::optional<double> slope_of(const RunRecord& run, const Axis& axis, Metric metric) {
  const Track track = track_of(run, axis, metric, axis.training(run));
  if (track.x.size() < 3) return std::nullopt;
  return statistics::fitted_slope(track.x, track.y).value;
}

void set_slope(const std::vector<double>& slopes, ReportCurve& curve) {
  if (slopes.empty()) return;
  const statistics::Bounded mean = statistics::arithmetic_mean(slopes);
  curve.slope = mean.value;
  if (slopes.size() > 1) curve.slope_interval = mean.interval;
}

/// Returns the mean curve of some runs, without points if no run has any.
ReportCurve curve_of(const std::vector<const RunRecord*>& runs, const Axis& axis, Metric metric) {
  ReportCurve curve;
  std::vector<Track> tracks;
  std::vector<double> slopes;
  for (const RunRecord* run : runs) {
    Track track = track_of(*run, axis, metric, 0);
    if (!track.x.empty()) tracks.push_back(std::move(track));
    if (const auto slope = slope_of(*run, axis, metric)) slopes.push_back(*slope);
  }
  curve.metric = metric_info(metric).key;
  curve.axis = axis.name;
  if (!tracks.empty()) curve.points = mean_points(tracks);
  set_slope(slopes, curve);
  return curve;
}

/// Returns the time after which a track stays at or below `target` [log]; NaN if it ends above. A
/// track that begins below counts from its first point.
double time_below(const Track& track, double target) {
  if (track.x.empty() || track.y.back() > target) return std::nan("");
  std::size_t i = track.x.size() - 1;
  while (i > 0 && track.y[i - 1] <= target) --i;
  if (i == 0) return std::exp(track.x.front());
  const double t = (track.y[i - 1] - target) / (track.y[i - 1] - track.y[i]);
  return std::exp(track.x[i - 1] + t * (track.x[i] - track.x[i - 1]));
}

double time_to_equal_error(const RunRecord& run, const RunRecord* baseline) {
  if (baseline == nullptr) return std::nan("");
  const double target = std::log(baseline->errors[Metric::relative_mse]);
  return time_below(track_of(run, kAxes[1], Metric::relative_mse, 0), target);
}

}  // namespace

std::vector<ReportCurve> convergence_curves(const ExperimentResults& results) {
  std::vector<ReportCurve> curves;
  for (const PlannedCell& cell : results.plan.cells) {
    const std::string& scene = results.config.scenes[cell.scene].name;
    const std::string& method = results.config.methods[cell.method].name;
    std::vector<const RunRecord*> runs;
    for (const RunRecord& run : results.records) {
      if (run.scene == scene && run.method == method) runs.push_back(&run);
    }
    for (const Metric metric : checkpoint_metrics()) {
      for (const Axis& axis : kAxes) {
        ReportCurve curve = curve_of(runs, axis, metric);
        curve.scene = scene;
        curve.method = method;
        if (!curve.points.empty()) curves.push_back(std::move(curve));
      }
    }
  }
  return curves;
}

ReportTable equal_error_table(const ExperimentResults& results) {
  ReportTable table{"seconds_to_equal_error",
                    "time to equal error",
                    "s",
                    "Seconds after which the method's relMSE stays below what the baseline has at "
                    "its end with the same seed, between checkpoints on logarithmic axes and not "
                    "before the first; none where a seed does not reach it",
                    Better::lower,
                    {}};
  for (const ExperimentScene& scene : results.config.scenes) {
    table.rows.push_back(row_over_seeds(results, scene.name, true, time_to_equal_error));
  }
  return table;
}

}  // namespace pharos
