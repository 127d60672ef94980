#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/core/vec.h>
#include <pharos/statistics/point_sets.h>

#include "../coordinates.h"
#include "../frequencies.h"

namespace pharos::aligned::testing {

/// Returns independent random points in the unit square.
inline Coordinates random_points(std::size_t count) {
  RandomStream random(11, count);
  Coordinates points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d();
    points.x[i] = static_cast<double>(u.x), points.y[i] = static_cast<double>(u.y);
  }
  return points;
}

/// Returns the mean power of points over frequencies. Independent points have 1.
inline double mean_power(std::span<const Vec2> points, std::span<const TargetPower> frequencies,
                         int highest) {
  statistics::PowerSpectrum spectrum(highest);
  spectrum.add(points);
  double sum = 0;
  for (const TargetPower& v : frequencies) sum += spectrum.at(v.x, v.y);
  return sum / static_cast<double>(frequencies.size());
}

}  // namespace pharos::aligned::testing
