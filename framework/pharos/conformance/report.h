#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pharos::conformance {

enum class Verdict { passed, failed, not_applicable };

/// What one check says of one case of one plugin.
struct Finding {
  std::string contract, plugin;
  std::string module;    ///< library that registered the plugin
  std::string settings;  ///< the case: a YAML mapping on one line
  std::string check;     ///< see docs/contracts/conformance.md
  Verdict verdict = Verdict::passed;
  std::string detail;  ///< the first fault or the worst configuration; why not applicable
  std::optional<double> p_value;  ///< of statistical checks, corrected for their configurations
  double adjusted_p = 1;          ///< Holm over the report; set by finish()
};

/// What was found of all plugins that were tested.
struct Report {
  /// By contract, plugin, case and check; the same for any number of threads.
  std::vector<Finding> findings;
  /// Wall-clock seconds by (contract, plugin).
  std::map<std::pair<std::string, std::string>, double> seconds;

  /// Nothing failed.
  bool passed() const;
};

/// Adjusts the p-values of all findings (Holm 1979) and turns those at or below `family_level` red:
/// the probability that a sound set of plugins fails by chance is at most that.
void finish(Report& report, double family_level);

/// The names of the checks that failed.
std::set<std::string> failed_checks(const Report& report);

/// The report as a JSON document: an array of findings.
std::string to_json(const Report& report);

}  // namespace pharos::conformance
