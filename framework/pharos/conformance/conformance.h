#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/conformance/report.h>

/// Tests every registered plugin by the suite of its contract, see docs/contracts/conformance.md:
///
///     const conformance::Report report =
///         conformance::check_plugins(registry, {.module = "bsdfs"});
///     CHECK(report.passed());
namespace pharos::conformance {

/// The plugins to test. All are tested if both members are empty.
struct Selection {
  std::vector<std::string> names;  ///< names of plugins or contracts
  std::string module;              ///< only plugins that this module registered
};

struct Options {
  std::uint64_t seed = 1;
  double family_level = 0.01;  ///< probability of any false alarm in the report
};

/// Tests the selected plugins with their defaults, examples, choices and switches. The findings
/// depend on registry, selection and options alone, not on the number of threads. Throws InputError
/// for an unknown name or module, and if the selection contains no plugin.
Report check_plugins(const Registry& registry, const Selection& selection = {},
                     const Options& options = {});

}  // namespace pharos::conformance
