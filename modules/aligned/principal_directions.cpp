#include "principal_directions.h"

#include <bitset>

namespace pharos::aligned {
namespace {

/// The directions around which modes are still searched for.
class Candidates {
 public:
  Candidates() { open_.set(); }

  /// Returns the candidate with the largest share, or -1 if no candidate has a share above zero.
  int best(const DirectionDistribution& p) const {
    int best = -1;
    double largest = 0;
    for (int k = 0; k < kDirections; ++k) {
      if (!open_[static_cast<std::size_t>(k)] || p.share(k) <= largest) continue;
      largest = p.share(k);
      best = k;
    }
    return best;
  }
  /// Removes a direction and all directions that are less than `distance` away from it.
  void close(int direction, int distance) {
    open_.reset(static_cast<std::size_t>(direction));
    for (int k = 0; k < kDirections; ++k) {
      if (degrees_between(k, direction) < distance) open_.reset(static_cast<std::size_t>(k));
    }
  }

 private:
  std::bitset<kDirections> open_;
};

bool is_apart(int direction, const FreeDirections& found, int distance) {
  return std::all_of(found.begin(), found.end(),
                     [&](int other) { return degrees_between(direction, other) >= distance; });
}

}  // namespace

FreeDirections principal_directions(const DirectionHistogram& histogram,
                                    const PrincipalSettings& settings, int most) {
  FreeDirections found;
  const DirectionDistribution p(histogram, settings.axis_width, settings.floor);
  if (p.empty()) return found;
  Candidates candidates;
  while (found.count < most) {
    const int start = candidates.best(p);
    if (start < 0) break;
    const int mean = best_mean(p, settings.kappa, start, settings.window);
    const bool is_free = degrees_from_axis(mean) > settings.axis_width;
    if (is_free && p.mass(mean, settings.mass_width) >= settings.least_mass &&
        is_apart(mean, found, settings.min_distance)) {
      found.add(mean);
    }
    candidates.close(start, settings.min_distance);
    candidates.close(mean, settings.min_distance);
  }
  return found;
}

}  // namespace pharos::aligned
