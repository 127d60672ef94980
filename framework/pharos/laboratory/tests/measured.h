#pragma once

#include <string>

#include <pharos/config/module.h>
#include <pharos/laboratory/integrands/add_integrands.h>
#include <pharos/laboratory/laboratory.h>

#include "../../tests/fixtures.h"

extern "C" void pharos_module_register(pharos::Registry& registry);

namespace pharos::laboratory {

/// The beginning of a config file: an edge and a smooth integrand.
inline constexpr const char* kIntegrands = R"(integrands:
  - { name: edge, integrand: { type: edge, angles: [30] } }
  - { name: smooth, integrand: { type: smooth } }
)";

/// Returns a registry with all samplers of the project and all integrands.
inline Registry registry() {
  Registry all;
  pharos_module_register(all);
  add_integrands(all);
  return all;
}

/// Returns the config of a file that begins with `integrands`. The output folder is `folder`.
inline LaboratoryConfig config_of(const test::TemporaryFolder& folder, const std::string& more,
                                  const std::string& integrands = kIntegrands) {
  LaboratoryConfig config =
      load_laboratory(folder.write("test.yaml", integrands + more), {}, registry());
  config.output = folder.path();
  return config;
}

/// Returns the results for a file with kIntegrands and `more`.
inline LaboratoryResults measured(const std::string& more, const LaboratoryControl& control = {}) {
  const test::TemporaryFolder folder;
  return measure(config_of(folder, more), control);
}

/// The samplers of a file, the baseline first.
inline constexpr const char* kTwo = R"(samplers:
  - { name: random, sampler: independent }
  - { name: sobol, sampler: sobol }
)";

}  // namespace pharos::laboratory
