#include "results_file.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pharos/core/error.h>
#include <pharos/statistics/intervals.h>

namespace pharos::bench {
namespace {

using Json = nlohmann::ordered_json;

bool all_positive(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double v) { return v > 0; });
}

}  // namespace

void write_results(const std::string& file, const std::vector<Measurement>& all) {
  Json json = Json::object();
  for (const Measurement& m : all) {
    json[m.name] = {{"unit", m.unit}, {"value", m.median()}, {"runs", m.runs}};
  }
  std::ofstream out(file);
  out << json.dump(1) << '\n';
  if (!out.flush()) throw RunError(file + ": cannot be written");
}

OldResults read_results(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file + ": cannot be read");
  try {
    const Json json = Json::parse(in);
    OldResults results;
    for (const auto& [name, entry] : json.items()) {
      results[name] = entry.at("runs").get<std::vector<double>>();
    }
    const auto has_runs = [](const auto& figure) { return !figure.second.empty(); };
    if (std::ranges::all_of(results, has_runs)) return results;
  } catch (const Json::exception&) {
  }
  throw InputError(file + ": expected results that --json has written");
}

std::string comparison_line(const Measurement& now, const OldResults& old) {
  const auto found = old.find(now.name);
  if (found == old.end()) return fmt::format("{:<44} {:>10} {:>10.4g}", now.name, "", now.median());
  const Measurement before{now.name, now.unit, found->second};
  std::string line =
      fmt::format("{:<44} {:>10.4g} {:>10.4g}", now.name, before.median(), now.median());
  if (!all_positive(now.runs) || !all_positive(before.runs)) return line;
  const auto [ratio, interval] = statistics::ratio_of_means(now.runs, before.runs);
  const bool differs = interval.low > 1 || interval.high < 1;
  return line + fmt::format(" {:>8.3f} [{:.3f}, {:.3f}]{}", ratio, interval.low, interval.high,
                            differs ? " *" : "");
}

}  // namespace pharos::bench
