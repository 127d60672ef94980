// Costs of random numbers, for every registered sampler with its defaults or its first example. See
// sampler_costs.h.

#include <cstdio>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/conformance/subjects.h>

#include "sampler_costs.h"

namespace pharos::bench {

std::vector<Measurement> bench_samplers(int repeats) {
  const Registry registry = load_default_modules();
  const conformance::ExampleFolder folder;
  std::vector<Measurement> all;
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
