#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/conformance/report.h>

/// Tests every registered plugin by the suite of its contract, see docs/contracts/conformance.md:
///
///     const conformance::Report report = conformance::check_plugins(registry, {.module =
///     "bsdfs"}); CHECK(report.passed());
namespace pharos::conformance {

/// Which plugins are tested; empty: all.
struct Selection {
  std::vector<std::string> names;  ///< of plugins or contracts
  std::string module;              ///< only plugins that this module registered
};

struct Options {
  std::uint64_t seed = 1;
  double family_level = 0.01;  ///< probability of any false alarm in the report
};

/// Tests the selected plugins with their defaults, examples, choices and switches. Findings depend
/// on registry, selection and options alone, whatever the number of threads. Throws InputError for
/// a name or module that there is none of, and when the selection holds no plugin.
Report check_plugins(const Registry& registry, const Selection& selection = {},
                     const Options& options = {});

}  // namespace pharos::conformance
