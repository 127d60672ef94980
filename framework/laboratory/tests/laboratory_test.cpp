// The laboratory as a whole: known slopes, known variances, same bits.

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/config/module.h>
#include <pharos/laboratory/integrands/add_integrands.h>
#include <pharos/laboratory/laboratory.h>
#include <pharos/laboratory/laboratory_report.h>
#include <pharos/laboratory/point_stream.h>
#include <pharos/statistics/point_sets.h>

#include "../../tests/fixtures.h"

extern "C" void pharos_module_register(pharos::Registry& registry);

namespace pharos::laboratory {
namespace {

constexpr const char* kIntegrands = R"(integrands:
  - { name: edge, integrand: { type: edge, angles: [30] } }
  - { name: smooth, integrand: { type: smooth } }
)";

Registry registry() {
  Registry all;
  pharos_module_register(all);
  add_integrands(all);
  return all;
}

LaboratoryConfig config_of(const test::TemporaryFolder& folder, const std::string& more,
                           const std::string& integrands = kIntegrands) {
  LaboratoryConfig config =
      load_laboratory(folder.write("test.yaml", integrands + more), {}, registry());
  config.output = folder.path();
  return config;
}

LaboratoryResults measured(const std::string& more, const LaboratoryControl& control = {}) {
  const test::TemporaryFolder folder;
  return measure(config_of(folder, more), control);
}

constexpr const char* kTwo = R"(samplers:
  - { name: random, sampler: independent }
  - { name: sobol, sampler: sobol }
)";

TEST_CASE("slopes of independent and of Sobol' points are those of theory") {
  const LaboratoryResults results = measured(std::string(kTwo) +
                                             "samples: { from: 4, to: 11 }\n"
                                             "realisations: 400\nspectrum: { points: 0 }\n");
  const auto slope = [&](std::size_t s, std::size_t i) { return *results.samplers[s].slopes[i]; };
  for (const std::size_t i : {0u, 1u}) {
    const VarianceSlope random = slope(0, i);
    CHECK(random.slope.interval.low <= -1);
    CHECK(random.slope.interval.high >= -1);
    CHECK(std::abs(random.slope.value + 1) < 0.05);
    CHECK(random.misfit < 3);
  }
  CHECK(slope(1, 0).slope.value == doctest::Approx(-1.5).epsilon(0.05));
  CHECK(slope(1, 1).slope.value < -2);
  CHECK(results.samplers[0].spectrum.empty());
}

TEST_CASE("the variance of independent points is the integrand's, over their number") {
  const LaboratoryResults results = measured(std::string(kTwo) +
                                             "samples: { from: 4, to: 6 }\n"
                                             "realisations: 4000\nspectrum: { points: 0 }\n");
  // The edge is 1 with probability 1/2. The squared Gaussian has the mean pi width^2.
  const double width = 0.15, mean = 2 * std::numbers::pi * width * width;
  const double expected[] = {0.25, std::numbers::pi * width * width - mean * mean};
  for (const std::size_t i : {0u, 1u}) {
    for (std::size_t n = 0; n < results.numbers.size(); ++n) {
      const VarianceEstimate& v = results.samplers[0].variances[i][n];
      CHECK(std::abs(std::log(v.value * results.numbers[n] / expected[i])) < 4 * v.log_error);
    }
  }
}

TEST_CASE("the variance of shifted points is the one that their spectrum foretells") {
  // The sum over frequencies of power times squared Fourier coefficient, over the number of points;
  // a Gaussian's coefficients are (2 pi width^2) exp(-2 pi^2 width^2 f^2).
  const LaboratoryResults results = measured(std::string(kTwo) +
                                             "samples: { from: 2, to: 4 }\nrealisations: 4000\n"
                                             "spectrum: { points: 16, realisations: 2000, "
                                             "max_frequency: 8 }\n");
  const double width = 0.15, mean = 2 * std::numbers::pi * width * width;
  for (const SamplerResults& sampler : results.samplers) {
    double expected = 0;
    for (int y = -8; y <= 8; ++y) {
      for (int x = -8; x <= 8; ++x) {
        const double fall = 2 * std::numbers::pi * std::numbers::pi * width * width;
        const double c = mean * std::exp(-fall * (x * x + y * y));
        expected += *sampler.spectrum.pixel(8 + x, 8 - y) * c * c / 16;
      }
    }
    CHECK(sampler.variances[1].back().value == doctest::Approx(expected).epsilon(0.1));
  }
}

TEST_CASE("all numbers are the same for any number of threads") {
  const std::string config = std::string(kTwo) +
                             "samples: { from: 4, to: 7 }\nrealisations: 600\n"
                             "spectrum: { points: 64, realisations: 4, max_frequency: 8 }\n";
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

/// For sets of 16 points.
std::unique_ptr<const PreparedSampler> prepared_sampler(const char* name) {
  const Registry all = registry();
  BuildContext context{all};
  ConfigNode resolved;
  return prepare(*all.build<Sampler>(ConfigNode::scalar(name), context, resolved), 1, 4);
}

TEST_CASE("sets depend on seed, number of points and realisation") {
  const auto prepared = prepared_sampler("sobol");
  const std::vector<Vec2> points = point_set(*prepared, {1, 4, 0});
  REQUIRE(points.size() == 16);
  CHECK(statistics::fills_elementary_intervals(points));
  CHECK(points == point_set(*prepared, {1, 4, 0}));
  CHECK(points != point_set(*prepared, {2, 4, 0}));
  CHECK(points != point_set(*prepared, {1, 4, 1}));
  CHECK(points[0] != point_set(*prepared, {1, 5, 0})[0]);
}

/// What a set of points was shifted by, which must be the same for all of its points.
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

TEST_CASE("shifts are uniform, of a realisation each, the same for every sampler") {
  const auto sobol = prepared_sampler("sobol"), independent = prepared_sampler("independent");
  PlanePoint sum;
  for (std::uint64_t r = 0; r < 400; ++r) {
    const PlanePoint shift = shift_of(*sobol, {1, 4, r});
    CHECK(shift.x == doctest::Approx(shift_of(*independent, {1, 4, r}).x).epsilon(1e-12));
    sum = {sum.x + shift.x, sum.y + shift.y};
  }
  // The standard error of the mean of 400 uniform numbers is 0.0144.
  CHECK(std::abs(sum.x / 400 - 0.5) < 0.05);
  CHECK(std::abs(sum.y / 400 - 0.5) < 0.05);
  const PlanePoint first = shift_of(*sobol, {1, 4, 0});
  CHECK(std::abs(first.x - first.y) > 1e-3);
  CHECK(std::abs(first.x - shift_of(*sobol, {1, 4, 1}).x) > 1e-3);
}

TEST_CASE("by default all registered samplers are measured, ratios are to the independent one") {
  const test::TemporaryFolder folder;
  const LaboratoryConfig config = config_of(folder, "");
  CHECK(config.samplers.size() == registry().names("sampler").size());
  CHECK(config.left_out.empty());
  CHECK(config.baseline == "independent");
  CHECK(config.resolved.find("sobol") != std::string::npos);
  CHECK(config_of(folder, kTwo).baseline == "random");
}

/// Samplers that cannot be had by their names alone: one adapts to a scene, one has a parameter
/// without a default.
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
  CHECK(config.left_out == std::vector<std::string>{"a_prober", "sized"});
  CHECK(config.samplers.size() == others);
  const auto named = folder.write(
      "one.yaml", std::string(kIntegrands) + "samplers:\n  - { name: x, sampler: a_prober }\n");
  CHECK(test::input_error_in(folder, [&] { load_laboratory(named, {}, all); }) ==
        "one.yaml:5:5: error: the sampler 'a_prober' adapts to a scene, and there is none here");
}

TEST_CASE("work that is stopped keeps the numbers that all samplers have") {
  std::atomic<bool> stop = false;
  LaboratoryControl control{.on_progress = {}, .stop = &stop};
  control.on_progress = [&](double fraction, double) { stop = fraction > 0.4; };
  const std::string config = std::string(kTwo) + "samples: { from: 4, to: 10 }\nrealisations: 64\n";
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

TEST_CASE("the files hold everything") {
  const test::TemporaryFolder folder;
  const LaboratoryResults results = measure(config_of(
      folder, std::string(kTwo) + "samples: { from: 4, to: 8 }\nfit: { from: 5, to: 8 }\n"
                                  "realisations: 64\nspectrum: { points: 16, realisations: 2, "
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
  std::ifstream page(folder / "report.html");
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  for (const char* part : {"\"subject\":\"integrand\"", "\"axis\":\"points\"", "Power spectra"}) {
    CHECK(html.find(part) != std::string::npos);
  }
}

}  // namespace
}  // namespace pharos::laboratory
