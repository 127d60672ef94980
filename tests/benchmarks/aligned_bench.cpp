// Costs of aligned sampling. `aligned.synthesis_s.N` is the time, on all cores, to synthesize a set
// of N points with one direction in addition to the axes. `aligned.value_ns` is the time of an
// aligned number, for paths that ask for eleven numbers, including its share of the beginning of a
// path. `sampler.aligned.*` is defined as in sampler_costs.h: two of eleven numbers are aligned,
// and nine come from the base sampler. `aligned.estimation_spp` is the time that the sampler takes
// before rendering, minus the time of its base, in units of one plain sample of all pixels. It is
// measured in the Cornell box with direct light alone, whose samples are cheap. `aligned.slope.*`
// is the slope of the variance on one edge and on two edges, with points aligned with them, over
// 2^8 to 2^12 points. `aligned.variance_gain.4096` is the smallest variance of the other samplers
// in configs/convergence/aligned.yaml on one edge, divided by the variance of aligned points.

#include <algorithm>
#include <aligned/synthesis.h>
#include <chrono>
#include <string_view>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/laboratory/integrands/add_integrands.h>
#include <pharos/laboratory/laboratory.h>
#include <pharos/rendering/render_job.h>

#include "bench_scenes.h"
#include "renders.h"
#include "sampler_costs.h"

namespace pharos::bench {
namespace {

constexpr PixelGrid kFilm{256, 256};
constexpr std::uint32_t kSamples = 64;
constexpr std::uint16_t kLights = 9;  ///< positions on lights; lens and BSDF make eleven numbers

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Measurement synthesis(int repeats) {
  aligned::SynthesisSettings settings;
  settings.points = 4096;
  settings.directions = {30};
  Measurement seconds{fmt::format("aligned.synthesis_s.{}", settings.points), "s", {}};
  for (int i = 0; i < repeats; ++i) {
    seconds.runs.push_back(seconds_of([&] { aligned::synthesize(settings); }));
  }
  return seconds;
}

/// Asks for eleven numbers, which are all aligned.
float aligned_values(const SampleStream& stream) {
  const Vec2 lens = stream.get_2d({Purpose::lens});
  const Vec2 bsdf = stream.get_2d({Purpose::bsdf_direction, 1});
  float sum = (lens.x + lens.y) + (bsdf.x + bsdf.y);
  for (std::uint16_t light = 0; light < kLights; ++light) {
    const Vec2 u = stream.get_2d({Purpose::light_position, 1, light});
    sum += u.x + u.y;
  }
  return sum;
}

std::vector<Measurement> values(int repeats) {
  const Registry registry = load_default_modules();
  BuildContext context{.registry = registry};
  ConfigNode resolved;
  const auto sampler =
      registry.build<Sampler>(parse_yaml("{ type: aligned, angles: [30], lights: 9, "
                                         "purposes: [light_position, bsdf_direction, lens] }",
                                         "aligned"),
                              context, resolved);
  const auto prepared = sampler->prepare(kTimedFilm, kTimedPlan, nullptr);
  Measurement value{"aligned.value_ns", "ns", {}};
  for (int i = 0; i < repeats; ++i) {
    value.runs.push_back(time_paths(*prepared, aligned_values) / (2 + kLights));
  }
  std::vector<Measurement> all = measure_sampler("aligned", *sampler, repeats);
  all.insert(all.begin(), value);
  return all;
}

LoadedConfig direct_light(const std::string& sampler) {
  return testing::config_from(
      scene_entry("cornell-box") +
      fmt::format("film: {{ width: {}, height: {}, filter: box }}\n"
                  "integrator: {{ type: path, max_depth: 2, light_selection: all }}\n"
                  "sampler: {}\nbudget: {{ spp: {} }}\n",
                  kFilm.width, kFilm.height, sampler, kSamples));
}

Measurement estimation(int repeats) {
  const LoadedConfig aligned = direct_light("aligned"), plain = direct_light("pmj02bn");
  const Scene scene(aligned.config.scene);
  const auto sensor = scene.sensor().prepare(kFilm.width, kFilm.height);
  const auto integrator =
      aligned.config.integrator->prepare({scene, *sensor, kFilm.width, kFilm.height});
  const auto probe = integrator->probe();
  const SamplePlan plan{.seed = 1, .samples_per_pixel = kSamples};
  const auto prepare = [&](const LoadedConfig& loaded) {
    return seconds_of([&] { loaded.config.sampler->prepare(kFilm, plan, probe.get()); });
  };
  prepare(aligned);  // so that sets are read before timing
  RenderJob job(plain.config);
  Measurement spp{"aligned.estimation_spp", "samples", {}};
  for (int i = 0; i < repeats; ++i) {
    const double looking = prepare(aligned) - prepare(plain);
    const double sample = job.run().times.rendering / kSamples;
    spp.runs.push_back(looking / sample);
  }
  return spp;
}

template <class Named>
std::size_t index_of(const std::vector<Named>& all, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(all, name, &Named::name) - all.begin());
}

/// Returns the gain on one edge at the largest number of points: the smallest variance of the other
/// samplers divided by the variance of the aligned points.
double variance_gain(const laboratory::LaboratoryResults& results, std::size_t edge,
                     std::size_t aligned) {
  double least = kInfinity;
  for (std::size_t i = 0; i < results.samplers.size(); ++i) {
    if (results.config.samplers[i].sampler->plugin_name() == "aligned") continue;
    least = std::min(least, results.samplers[i].variances[edge].back().value);
  }
  return least / results.samplers[aligned].variances[edge].back().value;
}

std::vector<Measurement> convergence(int repeats) {
  Registry registry = load_default_modules();
  laboratory::add_integrands(registry);
  std::vector<Measurement> all{{"aligned.slope.one_direction", "", {}},
                               {"aligned.slope.two_directions", "", {}},
                               {"aligned.variance_gain.4096", "", {}}};
  for (int i = 0; i < repeats; ++i) {
    const auto config = laboratory::load_laboratory(
        PHAROS_CONFIGS "/convergence/aligned.yaml",
        {"samples.to=12", "spectrum.points=0", fmt::format("seed={}", i + 1)}, registry);
    const std::size_t one = index_of(config.samplers, "aligned-31");
    const std::size_t two = index_of(config.samplers, "aligned-31-110");
    const std::size_t edge = index_of(config.integrands, "edge-31");
    const std::size_t edges = index_of(config.integrands, "two-edges");
    const laboratory::LaboratoryResults results = laboratory::measure(config);
    all[0].runs.push_back(results.samplers[one].slopes[edge]->slope.value);
    all[1].runs.push_back(results.samplers[two].slopes[edges]->slope.value);
    all[2].runs.push_back(variance_gain(results, edge, one));
  }
  return all;
}

}  // namespace

std::vector<Measurement> bench_aligned(int repeats) {
  // One run of the convergence takes most of a minute.
  constexpr int kMostSyntheses = 2, kMostConvergences = 1;
  std::vector<Measurement> all{synthesis(std::min(repeats, kMostSyntheses))};
  for (Measurement& m : values(repeats)) all.push_back(std::move(m));
  all.push_back(estimation(repeats));
  for (Measurement& m : convergence(std::min(repeats, kMostConvergences)))
    all.push_back(std::move(m));
  return all;
}

}  // namespace pharos::bench
