#include "growth_plots.h"

#include <array>
#include <map>
#include <string>

#include <fmt/format.h>

#include "plot.h"

namespace pharos::bench {
namespace {

/// Splits growth.PARAMETER.VALUE.FIGURE. Returns empty strings for other names.
std::array<std::string, 3> parts_of(const std::string& name) {
  constexpr std::string_view kPrefix = "growth.";
  if (!name.starts_with(kPrefix)) return {};
  const std::size_t first = kPrefix.size(), second = name.find('.', first), last = name.rfind('.');
  if (second == std::string::npos || last <= second) return {};
  return {name.substr(first, second - first), name.substr(second + 1, last - second - 1),
          name.substr(last + 1)};
}

/// Returns the plots by name. Their points are in the order in which they were measured.
std::map<std::string, Plot> plots_of(const std::vector<Measurement>& all) {
  std::map<std::string, Plot> plots;
  for (const Measurement& m : all) {
    const auto [parameter, value, figure] = parts_of(m.name);
    if (parameter.empty() || !(m.median() > 0)) continue;
    Plot& plot = plots[parameter + "-" + figure];
    plot.title = fmt::format("{} [{}]", figure, m.unit);
    plot.x_name = parameter;
    plot.curves.resize(1);
    plot.curves[0].points.push_back({std::stod(value), m.median()});
  }
  return plots;
}

}  // namespace

void write_growth_plots(const std::filesystem::path& folder, const std::vector<Measurement>& all) {
  for (const auto& [name, plot] : plots_of(all)) {
    if (plot.curves[0].points.size() < 2) continue;
    write_plot(folder / fmt::format("growth-{}.svg", name), plot);
  }
}

}  // namespace pharos::bench
