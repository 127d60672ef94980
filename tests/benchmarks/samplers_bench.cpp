// Costs of random numbers, for every registered sampler with its defaults or its first example. See
// sampler_costs.h. The cost of a power spectrum, which measures the quality of point sets, is here,
// too.

#include <chrono>
#include <cstdio>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/subjects.h>
#include <pharos/core/random.h>
#include <pharos/statistics/point_sets.h>

#include "sampler_costs.h"

namespace pharos::bench {
namespace {

Measurement measure_power_spectrum(int repeats) {
  constexpr int kPoints = 4096, kHighest = 64;
  RandomStream random(1);
  std::vector<Vec2> points;
  for (int i = 0; i < kPoints; ++i) points.push_back(random.next_2d());
  Measurement cost{fmt::format("points.power_spectrum_ms.n{}", kPoints), "ms", {}};
  for (int i = 0; i < repeats; ++i) {
    statistics::PowerSpectrum spectrum(kHighest);
    const auto start = std::chrono::steady_clock::now();
    spectrum.add(points);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    cost.runs.push_back(elapsed.count());
  }
  return cost;
}

}  // namespace

std::vector<Measurement> bench_samplers(int repeats) {
  const Registry registry = load_default_modules();
  const conformance::ExampleFolder folder;
  std::vector<Measurement> all{measure_power_spectrum(repeats)};
  for (const auto& s : conformance::first_cases(registry, Sampler::contract_name, folder.path())) {
    const auto& sampler = static_cast<const Sampler&>(*s.component);
    if (sampler.needs_probe()) {
      fmt::print(stderr, "{} is left out: it needs an integrand\n", s.plugin->name);
      continue;
    }
    for (Measurement& m : measure_sampler(s.plugin->name, sampler, repeats)) all.push_back(m);
  }
  return all;
}

}  // namespace pharos::bench
