#pragma once

#include <cmath>
#include <numbers>

namespace pharos {

/// The integral of f(angle from the axis in radians) over the sphere of directions, by the midpoint
/// rule.
template <class F>
double axial_integral(const F& f) {
  constexpr int steps = 100'000;
  constexpr double step = std::numbers::pi / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = (i + 0.5) * step;
    sum += f(angle) * std::sin(angle);
  }
  return 2 * std::numbers::pi * step * sum;
}

}  // namespace pharos
