#include "point_set_library.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <pharos/core/error.h>

#include "shipped_sets.h"

namespace pharos::aligned {
namespace {

constexpr std::array<Symmetry, 4> kSymmetries{
    {{false, false}, {true, false}, {false, true}, {true, true}}};

/// Returns the multiple of `step` that is nearest to an angle, in [0, 180).
int rounded(double degrees, int step) {
  const double turned = degrees - 180 * std::floor(degrees / 180);
  return static_cast<int>(std::lround(turned / step)) * step % 180;
}

/// Applies the symmetry to all directions and sorts them: the set of two directions does not depend
/// on their order.
std::vector<int> turned(std::span<const int> directions, Symmetry symmetry) {
  std::vector<int> all;
  std::ranges::transform(directions, std::back_inserter(all), symmetry);
  std::ranges::sort(all);
  return all;
}

PointSet turned(PointSet set, Symmetry symmetry) {
  std::ranges::transform(set, set.begin(), symmetry);
  return set;
}

bool is_first(const std::vector<int>& directions) {
  return choose_set(directions, 0).set.directions == directions;
}

void check_count(std::span<const double> directions) {
  if (directions.size() <= 2) return;
  throw InputError(
      fmt::format("expected at most two directions beside the axes, found {}", directions.size()));
}

}  // namespace

SetChoice choose_set(std::span<const int> directions, std::uint32_t points) {
  SetChoice choice{{points, turned(directions, kSymmetries.front())}, kSymmetries.front()};
  for (const Symmetry symmetry : kSymmetries) {
    // A symmetry applied twice is the identity, so the same symmetry maps the set back.
    std::vector<int> there = turned(directions, symmetry);
    if (there < choice.set.directions) choice = {{points, std::move(there)}, symmetry};
  }
  return choice;
}

SynthesisSettings settings_of(const SetName& name) {
  SynthesisSettings settings;
  settings.points = name.points;
  settings.directions.assign(name.directions.begin(), name.directions.end());
  return settings;
}

PointSetLibrary::PointSetLibrary(Options options)
    : pair_step_(options.pair_step),
      cache_(options.cache_folder.empty() ? default_set_folder() : options.cache_folder) {
  if (pair_step_ < 1 || 45 % pair_step_ != 0) {
    throw InputError(fmt::format("expected a divisor of 45 degrees, found {}", pair_step_));
  }
}

std::vector<int> PointSetLibrary::snapped(std::span<const double> wanted) const {
  check_count(wanted);
  std::vector<int> on_grid;
  double left = 0;  // the direction that remains if the grid does not hold two
  for (const double degrees : wanted) {
    const int direction = rounded(degrees, wanted.size() == 1 ? 1 : pair_step_);
    const bool is_known = direction % 90 == 0 || std::ranges::count(on_grid, direction) > 0;
    if (is_known) continue;
    if (on_grid.empty()) left = degrees;
    on_grid.push_back(direction);
  }
  if (on_grid.size() < 2) return {rounded(left, 1)};
  std::ranges::sort(on_grid);
  return on_grid;
}

PointSet PointSetLibrary::find(std::span<const double> wanted, std::uint32_t points) const {
  const SetChoice choice = choose_set(snapped(wanted), points);
  return turned(*find(choice.set), choice.symmetry);
}

std::optional<PointSet> PointSetLibrary::find(const SetName& name,
                                              const SynthesisControl& control) const {
  if (name.directions.size() == 1) {
    if (auto shipped = shipped_set(name.directions.front(), name.points)) return shipped;
  }
  const SynthesisSettings settings = settings_of(name);
  if (auto kept = cache_.find(settings)) return kept;
  Synthesis made = synthesize(settings, control);
  if (made.points.empty()) return std::nullopt;
  cache_.keep(settings, made.points);
  return std::move(made.points);
}

std::vector<SetName> PointSetLibrary::names(int directions, std::uint32_t points) const {
  std::vector<SetName> all;
  const int step = directions == 1 ? 1 : pair_step_;
  for (int first = 0; first < 180; first += step) {
    if (directions == 1) {
      if (is_first({first})) all.push_back({points, {first}});
      continue;
    }
    for (int second = first + step; second < 180; second += step) {
      const bool has_axis = first % 90 == 0 || second % 90 == 0;
      if (!has_axis && is_first({first, second})) all.push_back({points, {first, second}});
    }
  }
  return all;
}

}  // namespace pharos::aligned
