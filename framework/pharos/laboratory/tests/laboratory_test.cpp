// Tests of the laboratory as a whole: dependencies of the sets, reproducibility, stopping, files.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/laboratory/laboratory_report.h>
#include <pharos/laboratory/point_stream.h>
#include <pharos/statistics/point_sets.h>

#include "measured.h"

namespace pharos::laboratory {
namespace {

TEST_CASE("numbers of points are written in full") {
  LaboratoryResults large = measured(std::string(kTwo) +
                                     "samples: { from: 4, to: 6 }\n"
                                     "realizations: 16\nspectrum: { points: 0 }\n");
  large.numbers.back() = 1 << 20;
  CHECK(text_tables(large).find("variance at 1048576 points") != std::string::npos);
  CHECK(laboratory_report(large).tables[1].definition.find("1048576 points") != std::string::npos);
}

TEST_CASE("all numbers are the same for any number of threads") {
  const std::string config = std::string(kTwo) +
                             "samples: { from: 4, to: 7 }\nrealizations: 600\n"
                             "spectrum: { points: 64, realizations: 4, max_frequency: 8 }\n";
  std::vector<std::string> tables;
  for (const int threads : {1, 2, 3, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    LaboratoryResults results;
    tbb::task_arena(threads).execute([&] { results = measured(config); });
    tables.push_back(variances_csv(results) + text_tables(results));
    for (const SamplerResults& sampler : results.samplers) {
      for (const float power : sampler.spectrum.values()) {
        tables.back() += std::to_string(power);
      }
    }
  }
  CHECK(tables[0].size() > 1000);
  for (const std::string& table : tables) CHECK(table == tables[0]);
}

/// Returns a sampler prepared for sets of 16 points, with the tables of preparation `number`.
std::unique_ptr<const PreparedSampler> prepared_sampler(const char* name,
                                                        std::uint64_t number = 0) {
  const Registry all = registry();
  BuildContext context{all};
  ConfigNode resolved;
  return prepare(*all.build<Sampler>(ConfigNode::scalar(name), context, resolved), {1, 4, number});
}

TEST_CASE("sets depend on seed, number of points and realization") {
  const auto prepared = prepared_sampler("sobol");
  const std::vector<Vec2> points = point_set(*prepared, {1, 4, 0});
  REQUIRE(points.size() == 16);
  CHECK(statistics::fills_elementary_intervals(points));
  CHECK(points == point_set(*prepared, {1, 4, 0}));
  CHECK(points != point_set(*prepared, {2, 4, 0}));
  CHECK(points != point_set(*prepared, {1, 4, 1}));
  CHECK(points[0] != point_set(*prepared, {1, 5, 0})[0]);
}

TEST_CASE("tables are those of a preparation") {
  const auto first = prepared_sampler("pmj02"), again = prepared_sampler("pmj02");
  const auto second = prepared_sampler("pmj02", 1);
  CHECK(point_set(*first, {1, 4, 0}) == point_set(*again, {1, 4, 0}));
  CHECK(point_set(*first, {1, 4, 0}) != point_set(*second, {1, 4, 0}));
}

/// Independent points. Records all seeds that it was prepared with.
class Counting final : public Sampler {
 public:
  using Settings = NoSettings;
  explicit Counting(const Settings& = {}) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override {
    const std::scoped_lock lock(guard);
    seeds.push_back(plan.seed);
    const Registry all = registry();
    BuildContext context{all};
    ConfigNode resolved;
    return all.build<Sampler>(ConfigNode::scalar("independent"), context, resolved)
        ->prepare(grid, plan, probe);
  }

  static inline std::mutex guard;
  static inline std::vector<std::uint64_t> seeds;
};

TEST_CASE("every group of realizations has a preparation of its own") {
  const test::TemporaryFolder folder;
  Registry all = registry();
  all.add<Counting>("counting", "Counts");
  const auto file = folder.write(
      "test.yaml",
      std::string(kIntegrands) +
          "samplers: [{ name: a, sampler: counting }, { name: b, sampler: counting }]\n"
          "samples: { from: 4, to: 6 }\nrealizations: 40\npreparations: 9\n"
          "spectrum: { points: 0 }\n");
  const LaboratoryResults results = measure(load_laboratory(file, {}, all));
  const std::set<std::uint64_t> different(Counting::seeds.begin(), Counting::seeds.end());
  CHECK(Counting::seeds.size() == 2 * 3 * 9);
  CHECK(different.size() == Counting::seeds.size());
  // Equal samplers with different names have different points.
  for (std::size_t n = 0; n < 3; ++n) {
    CHECK(results.samplers[0].variances[1][n].value != results.samplers[1].variances[1][n].value);
  }
}

/// Returns the shift of a point set, which must be the same for all of its points.
PlanePoint shift_of(const PreparedSampler& prepared, const SetKey& key) {
  const std::vector<Vec2> points = point_set(prepared, key);
  const std::vector<PlanePoint> shifted = shifted_point_set(prepared, key);
  REQUIRE(shifted.size() == points.size());
  const auto offset = [&](std::size_t i) {
    const double x = shifted[i].x - points[i].x, y = shifted[i].y - points[i].y;
    return PlanePoint{x - std::floor(x), y - std::floor(y)};
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(shifted[i].x < 1);
    CHECK(shifted[i].y < 1);
    CHECK(offset(i).x == doctest::Approx(offset(0).x).epsilon(1e-12));
    CHECK(offset(i).y == doctest::Approx(offset(0).y).epsilon(1e-12));
  }
  return offset(0);
}

TEST_CASE("shifts are uniform, of a realization and a sampler's name each") {
  const auto sobol = prepared_sampler("sobol");
  const std::uint64_t one = seed_of(1, "one"), other = seed_of(1, "other");
  PlanePoint sum;
  double product = 0;
  for (std::uint64_t r = 0; r < 400; ++r) {
    const PlanePoint shift = shift_of(*sobol, {one, 4, r});
    sum = {sum.x + shift.x, sum.y + shift.y};
    product += (shift.x - 0.5) * (shift_of(*sobol, {other, 4, r}).x - 0.5);
  }
  // The standard error of the mean of 400 uniform numbers is 0.0144. The standard error of the mean
  // product of two independent centered numbers is 1 / 240, and the mean product of equal ones is 1
  // / 12.
  CHECK(std::abs(sum.x / 400 - 0.5) < 0.05);
  CHECK(std::abs(sum.y / 400 - 0.5) < 0.05);
  CHECK(std::abs(product / 400) < 4.0 / 240);
  const PlanePoint first = shift_of(*sobol, {one, 4, 0});
  CHECK(std::abs(first.x - first.y) > 1e-3);
  CHECK(std::abs(first.x - shift_of(*sobol, {one, 4, 1}).x) > 1e-3);
  CHECK(seed_of(1, "ab") != seed_of(1, "ba"));
  CHECK(seed_of(1, "a") != seed_of(2, "a"));
}

TEST_CASE(
    "by default all samplers that need no settings are measured, ratios are to the independent "
    "one") {
  const test::TemporaryFolder folder;
  const LaboratoryConfig config = config_of(folder, "");
  CHECK(config.samplers.size() + 1 == registry().names("sampler").size());
  CHECK(config.left_out == std::vector<std::string>{"point_list"});
  CHECK(config.baseline == "independent");
  CHECK(config.resolved.find("sobol") != std::string::npos);
  CHECK(config_of(folder, kTwo).baseline == "random");
}

/// Samplers that need more than their names: one adapts to a scene, one has a parameter without a
/// default.
template <bool Probes>
class Demanding final : public Sampler {
 public:
  struct Settings {
    int size = 1;
    static void describe(Schema<Settings>& s) {
      auto size = s.field("size", &Settings::size, "Of something");
      if (!Probes) size.required();
    }
  };
  explicit Demanding(const Settings&) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid&, const SamplePlan&,
                                                 const IntegrandProbe*) const override {
    return nullptr;
  }
  bool needs_probe() const override { return Probes; }
};

TEST_CASE("samplers that need a scene or settings are left out, and refused by name") {
  const test::TemporaryFolder folder;
  Registry all = registry();
  const std::size_t others = all.names("sampler").size();
  all.add<Demanding<true>>("a_prober", "Needs a scene");
  all.add<Demanding<false>>("sized", "Needs a setting");
  const LaboratoryConfig config = load_laboratory(folder.write("all.yaml", kIntegrands), {}, all);
  CHECK(config.left_out == std::vector<std::string>{"a_prober", "point_list", "sized"});
  CHECK(config.samplers.size() + 1 == others);
  const auto named = folder.write(
      "one.yaml", std::string(kIntegrands) + "samplers:\n  - { name: x, sampler: a_prober }\n");
  CHECK(test::input_error_in(folder, [&] { load_laboratory(named, {}, all); }) ==
        "one.yaml:5:5: error: the sampler 'a_prober' adapts to a scene, and there is none here");
}

TEST_CASE("work that is stopped keeps the numbers that all samplers have") {
  std::atomic<bool> stop = false;
  LaboratoryControl control{.on_progress = {}, .stop = &stop};
  control.on_progress = [&](double fraction, double) { stop = fraction > 0.4; };
  const std::string config = std::string(kTwo) +
                             "samples: { from: 4, to: 10 }\nrealizations: 64\n"
                             "spectrum: { points: 16, realizations: 2, max_frequency: 3 }\n";
  const LaboratoryResults results = measured(config, control);
  CHECK(results.stopped);
  CHECK(results.numbers.size() > 2);
  CHECK(results.numbers.size() < 7);
  for (const SamplerResults& sampler : results.samplers) {
    CHECK(sampler.variances[0].size() == results.numbers.size());
    CHECK(sampler.slopes[0]);
    CHECK(sampler.spectrum.empty());
  }
  stop = true;
  CHECK(measured(config, {.on_progress = {}, .stop = &stop}).numbers.empty());
}

TEST_CASE("spectra are stopped between realizations, and whole work is not called stopped") {
  std::atomic<bool> stop = false;
  double stop_at = 0.1, last = 0;
  int late = 0;
  LaboratoryControl control{.on_progress = {}, .stop = &stop};
  control.on_progress = [&](double fraction, double) {
    late += stop ? 1 : 0;
    stop = stop || fraction > stop_at;
    last = fraction;
  };
  const std::string config = std::string(kTwo) +
                             "samples: { from: 4, to: 6 }\nrealizations: 16\n"
                             "spectrum: { points: 256, realizations: 20, max_frequency: 16 }\n";
  const LaboratoryResults cut = measured(config, control);
  CHECK(cut.stopped);
  CHECK(cut.numbers.size() == 3);
  CHECK(cut.samplers[0].slopes[0]);
  CHECK((cut.samplers[0].spectrum.empty() || cut.samplers[1].spectrum.empty()));
  CHECK(late <= 2);
  const auto facts = laboratory_report(cut).facts;
  CHECK(std::any_of(facts.begin(), facts.end(), [](const auto& fact) {
    return fact.second.find("variances and slopes are complete") != std::string::npos;
  }));
  stop = false;
  stop_at = 1 - 1e-9;
  const LaboratoryResults whole = measured(config, control);
  CHECK(stop);
  CHECK_FALSE(whole.stopped);
  CHECK(last == doctest::Approx(1));
  CHECK_FALSE(whole.samplers[1].spectrum.empty());
}

TEST_CASE("the files hold everything") {
  const test::TemporaryFolder folder;
  const LaboratoryResults results = measure(config_of(
      folder, std::string(kTwo) + "samples: { from: 4, to: 8 }\nfit: { from: 5, to: 8 }\n"
                                  "realizations: 64\nspectrum: { points: 16, realizations: 2, "
                                  "max_frequency: 3 }\n"));
  write_results(results);
  std::ifstream in(folder / "results.json");
  const auto json = nlohmann::json::parse(in);
  CHECK(json["complete"] == true);
  CHECK(json["integrands"]["edge"]["mean"].get<double>() == doctest::Approx(0.5));
  CHECK(json["samplers"]["sobol"]["spectrum"].size() == 7);
  REQUIRE(json["curves"].size() == 4);
  const auto& curve = json["curves"][1];
  CHECK(curve["integrand"] == "edge");
  CHECK(curve["sampler"] == "sobol");
  CHECK(curve["slope"]["value"] == results.samplers[1].slopes[0]->slope.value);
  REQUIRE(curve["variances"].size() == 5);
  CHECK(curve["variances"][4]["points"] == 256);
  CHECK(curve["variances"][4]["ratio"].get<double>() ==
        doctest::Approx(results.samplers[1].variances[0][4].value /
                        results.samplers[0].variances[0][4].value));
  CHECK(json["curves"][0]["sampler"] == "random");
  CHECK(json["curves"][0]["variances"][4]["ratio"].is_null());
  const ReportTable table = laboratory_report(results).tables.at(1);
  CHECK_FALSE(table.rows[0].cells[0].ratio);
  CHECK(table.rows[0].cells[1].ratio);
  const std::string html = test::bytes_of(folder / "report.html");
  for (const char* part : {"\"subject\":\"integrand\"", "\"axis\":\"points\"", "Power spectra"}) {
    CHECK(html.find(part) != std::string::npos);
  }
}

}  // namespace
}  // namespace pharos::laboratory
