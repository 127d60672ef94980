#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pharos::conformance {

enum class Verdict { passed, failed, not_applicable };

/// The finding of one check for one case of one plugin.
struct Finding {
  std::string contract, plugin;
  std::string module;    ///< library that registered the plugin
  std::string settings;  ///< the case: a YAML mapping on one line
  std::string check;     ///< see docs/contracts/conformance.md
  Verdict verdict = Verdict::passed;
  std::string detail;  ///< first fault or worst configuration; if not applicable, the reason
  std::optional<double> p_value;  ///< of statistical checks, corrected for their configurations
  double adjusted_p = 1;          ///< Holm's correction over the report; set by finish()
};

/// The findings for all plugins that were tested.
struct Report {
  /// Ordered by contract, plugin, case and check. The same for any number of threads.
  std::vector<Finding> findings;
  /// Wall-clock seconds by (contract, plugin).
  std::map<std::pair<std::string, std::string>, double> seconds;

  /// Whether no check failed.
  bool passed() const;
};

/// Adjusts the p-values of all findings (Holm 1979) and marks findings at or below `family_level`
/// as failed. The probability that a sound set of plugins fails by chance is at most
/// `family_level`.
void finish(Report& report, double family_level);

/// Returns the names of the checks that failed.
std::set<std::string> failed_checks(const Report& report);

/// Returns the report as a JSON document, an array of findings.
std::string to_json(const Report& report);

}  // namespace pharos::conformance
