// Tests of the tables, curves and CSV files of an experiment's runs.

#include <cmath>

#include <doctest/doctest.h>

#include <pharos/experiments/metrics/summary.h>
#include <pharos/experiments/runner/results_files.h>

using namespace pharos;

namespace {

constexpr std::size_t kScene = 0;

/// Returns a run with the relMSE `scale` / samples that takes `pace` seconds per sample.
RunRecord run(const std::string& method, std::uint64_t seed, double scale, double pace) {
  RunRecord record{.scene = "s", .method = method, .seed = seed, .samples_per_pixel = 64};
  record.version = "0";
  record.times.rendering = 64 * pace;
  record.errors[Metric::relative_mse] = scale / 64;
  for (double samples = 1; samples <= 64; samples *= 2) {
    Checkpoint checkpoint{samples, samples * pace, {}};
    checkpoint.errors[Metric::relative_mse] = scale / samples;
    record.checkpoints.push_back(checkpoint);
  }
  return record;
}

ExperimentResults results_of(std::vector<RunRecord> records) {
  ExperimentResults results;
  results.config.scenes.push_back({.name = "s"});
  results.config.methods = {{.name = "base"}, {.name = "fast"}};
  results.config.baseline = "base";
  results.config.seeds = 2;
  for (const std::size_t method : {0, 1}) results.plan.cells.push_back({kScene, method});
  results.run_count = records.size();
  results.records = std::move(records);
  return results;
}

/// Returns two seeds of a baseline, and of a method with half its error at twice its speed.
ExperimentResults two_methods() {
  return results_of({run("base", 1, 1, 0.01), run("fast", 1, 0.5, 0.005), run("base", 2, 4, 0.01),
                     run("fast", 2, 2, 0.005)});
}

const ReportTable& table(const std::vector<ReportTable>& tables, const std::string& key) {
  for (const ReportTable& each : tables) {
    if (each.key == key) return each;
  }
  throw std::runtime_error("no table " + key);
}

const ReportCurve& curve(const std::vector<ReportCurve>& curves, const std::string& method,
                         const std::string& axis) {
  for (const ReportCurve& each : curves) {
    if (each.method == method && each.axis == axis && each.metric == "relative_mse") return each;
  }
  throw std::runtime_error("no curve");
}

}  // namespace

TEST_CASE("cells are geometric means; ratios pair the seeds") {
  const std::vector<ReportTable> tables = summary_tables(two_methods());
  const ReportTable& errors = table(tables, "relative_mse");
  REQUIRE(errors.rows.size() == 1);
  const ReportCell& base = errors.rows[0].cells[0];
  const ReportCell& fast = errors.rows[0].cells[1];
  CHECK(base.value == doctest::Approx(2.0 / 64));
  CHECK(fast.value == doctest::Approx(1.0 / 64));
  CHECK(*base.ratio == doctest::Approx(1));
  // The seeds differ by a factor of four. The ratio is still known exactly, because it is 1/2 for
  // both.
  CHECK(*fast.ratio == doctest::Approx(0.5));
  CHECK(fast.ratio_interval->low == doctest::Approx(0.5));
  CHECK(fast.ratio_interval->high == doctest::Approx(0.5));
  CHECK(fast.interval->low < 0.5 / 64);
  CHECK(fast.interval->high > 2.0 / 64);
  CHECK(*table(tables, "error_times_seconds").rows[0].cells[1].ratio == doctest::Approx(0.25));
}

TEST_CASE("a single seed has no intervals, a missing method no value, zeros no ratio") {
  ExperimentResults results = results_of({run("base", 1, 1, 0.01)});
  results.records[0].times.update = 0.5;
  const std::vector<ReportTable> tables = summary_tables(results);
  const ReportTable& errors = table(tables, "relative_mse");
  CHECK_FALSE(errors.rows[0].cells[0].interval);
  CHECK(std::isnan(errors.rows[0].cells[1].value));
  CHECK_FALSE(errors.rows[0].cells[1].ratio);
  CHECK_FALSE(table(tables, "seconds_update").rows[0].cells[0].ratio);
  CHECK_THROWS(table(tables, "model_bytes"));  // no method has a learned model
}

TEST_CASE("convergence curves are means over seeds, with the slope of each") {
  const std::vector<ReportCurve> curves = convergence_curves(two_methods());
  const ReportCurve& samples = curve(curves, "base", "samples");
  REQUIRE(samples.points.size() == 7);
  CHECK(samples.points[3].x == doctest::Approx(8));
  CHECK(samples.points[3].y == doctest::Approx(2.0 / 8));
  CHECK(*samples.slope == doctest::Approx(-1));
  CHECK(curve(curves, "base", "seconds").points[6].x == doctest::Approx(0.64));
}

TEST_CASE("curves of seeds that stopped elsewhere go from where all have begun to the first end") {
  const ExperimentResults results = results_of({run("base", 1, 1, 0.013), run("base", 2, 1, 0.01)});
  const std::vector<ReportCurve> curves = convergence_curves(results);
  const ReportCurve& seconds = curve(curves, "base", "seconds");
  // The first run lasts from 0.013 s to 0.832 s, the second from 0.01 s to 0.64 s.
  REQUIRE(seconds.points.size() == 7);
  CHECK(seconds.points.front().x == doctest::Approx(0.013));
  CHECK(seconds.points.back().x == doctest::Approx(0.64));
  // Errors fall as 1 / samples, and so does the interpolation between checkpoints.
  CHECK(seconds.points.front().y == doctest::Approx(std::sqrt(1 * 0.01 / 0.013)));
  CHECK(seconds.points.back().y == doctest::Approx(std::sqrt(0.013 / 0.64 * 0.01 / 0.64)));
}

TEST_CASE("slopes leave training out") {
  RunRecord guided = run("base", 1, 1, 0.01);
  guided.training_samples = 32;
  guided.times.training = 0.3;
  guided.times.update = 0.1;
  for (Checkpoint& checkpoint : guided.checkpoints) {
    checkpoint.samples_per_pixel += 32;
    checkpoint.seconds += 0.4;
  }
  const std::vector<ReportCurve> curves = convergence_curves(results_of({guided}));
  CHECK(*curve(curves, "base", "samples").slope == doctest::Approx(-1));
  CHECK(*curve(curves, "base", "seconds").slope == doctest::Approx(-1));
  CHECK(curve(curves, "base", "samples").points.front().x == doctest::Approx(33));
}

TEST_CASE("means are over the seeds that all methods have") {
  const ExperimentResults results =
      results_of({run("base", 1, 1, 0.01), run("fast", 1, 0.5, 0.01), run("base", 2, 100, 0.01)});
  const ReportTable errors = table(summary_tables(results), "relative_mse");
  CHECK(errors.rows[0].cells[0].value == doctest::Approx(1.0 / 64));
  CHECK_FALSE(errors.rows[0].cells[0].interval);
}

TEST_CASE("a method may have fewer seeds than others, and is compared with the same seeds") {
  ExperimentResults results = results_of({run("base", 1, 1, 0.01), run("fast", 1, 0.5, 0.01),
                                          run("base", 2, 4, 0.01), run("base", 3, 2, 0.01)});
  results.config.seeds = 3;
  results.config.methods[1].seeds = 1;
  const ReportTable errors = table(summary_tables(results), "relative_mse");
  const std::vector<ReportCell>& cells = errors.rows[0].cells;
  CHECK(cells[0].value == doctest::Approx(2.0 / 64));
  CHECK(cells[0].interval);
  CHECK(cells[1].value == doctest::Approx(0.5 / 64));
  CHECK(*cells[1].ratio == doctest::Approx(0.5));
  CHECK_FALSE(cells[1].ratio_interval);
}

TEST_CASE("a row's means are of one kind, and errors of zero have a table") {
  const ExperimentResults results = results_of({run("base", 1, 1, 0.01), run("fast", 1, 0, 0.01),
                                                run("base", 2, 9, 0.01), run("fast", 2, 1, 0.01)});
  const ReportTable errors = table(summary_tables(results), "relative_mse");
  CHECK(errors.rows[0].cells[0].value ==
        doctest::Approx(5.0 / 64));  // arithmetic, because another mean of the row is arithmetic
  CHECK(errors.rows[0].cells[1].value == doctest::Approx(0.5 / 64));
  CHECK_FALSE(errors.rows[0].cells[1].ratio);
  const ExperimentResults none = results_of({run("base", 1, 0, 0.01), run("fast", 1, 0, 0.01)});
  CHECK(table(summary_tables(none), "relative_mse").rows[0].cells[0].value == 0);
}

TEST_CASE("time to equal error: where a run falls below the baseline's end with its seed") {
  const ReportTable table = equal_error_table(two_methods());
  const std::vector<ReportCell>& cells = table.rows[0].cells;
  CHECK(cells[0].value == doctest::Approx(0.64));
  // With half the error at each sample, 32 samples are enough, at twice the speed.
  CHECK(cells[1].value == doctest::Approx(0.16));
  CHECK(*cells[1].ratio == doctest::Approx(0.25));
  CHECK(cells[1].ratio_interval->high == doctest::Approx(0.25));

  const ExperimentResults worse = results_of({run("base", 1, 1, 0.01), run("fast", 1, 3, 0.01)});
  CHECK(std::isnan(equal_error_table(worse).rows[0].cells[1].value));
  CHECK(*equal_error_table(worse).rows[0].cells[0].ratio == doctest::Approx(1));
  // If the baseline's seeds end at different times, its value is the geometric mean of these times.
  const ExperimentResults uneven = results_of({run("base", 1, 1, 0.013), run("fast", 1, 0.5, 0.01),
                                               run("base", 2, 1, 0.01), run("fast", 2, 0.5, 0.01)});
  CHECK(equal_error_table(uneven).rows[0].cells[0].value ==
        doctest::Approx(std::sqrt(0.832 * 0.64)));
}

TEST_CASE(
    "CSV: a line a run and a line a checkpoint, numbers that read back, nothing for unknown") {
  const ExperimentResults results = results_of({run("base", 1, 1, 0.01)});
  CHECK(runs_csv(results) ==
        "scene,method,seed,samples_per_pixel,mse,capped_mse,relative_mse,trimmed_relative_mse,"
        "floored_relative_mse,mape,smape,psnr,flip,"
        "hdr_flip,invalid_pixels,invalid_paths,rays,gain,noise_ratio,guiding_is_off,model_bytes,"
        "seconds_preparation,seconds_sampler,seconds_training,seconds_update,seconds_rendering,"
        "peak_bytes,version\n"
        "s,base,1,64,,,0.015625,,,,,,,,0,0,0,,,0,0,0,0,0,0,0.64,,0\n");
  const std::string measures = measures_csv(results);
  CHECK(measures.find("scene,method,seed,measure,unit,value\n"
                      "s,base,1,relative_mse,,0.015625\n"
                      "s,base,1,samples_per_pixel,,64\n") == 0);
  CHECK(measures.find("s,base,1,seconds,s,0.64\n") != std::string::npos);
  CHECK(measures.find("gain") == std::string::npos);  // unknown
  const std::string curve = convergence_csv(results);
  CHECK(std::count(curve.begin(), curve.end(), '\n') == 8);
  CHECK(curve.find("s,base,1,2,0.02,,,0.5,\n") != std::string::npos);
}
