#pragma once

#include <cstddef>
#include <vector>

namespace pharos {

/// One float per pixel, rows from the top.
struct Plane {
  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
  float* row(std::size_t y) { return values.data() + y * width; }
  const float* row(std::size_t y) const { return values.data() + y * width; }

  int width = 0, height = 0;
  std::vector<float> values;
};

/// Weights of the pixels from -radius to +radius along one axis.
struct Kernel {
  int radius() const { return static_cast<int>(weights.size() / 2); }

  std::vector<float> weights;  ///< 2 radius + 1
};

/// Returns the plane filtered by the separable filter along_x(i) along_y(j). The value at (x, y) is
/// the sum of weights times the values at (x + i, y + j). Outside of the plane, the values at the
/// border continue.
Plane filtered(const Plane& plane, const Kernel& along_x, const Kernel& along_y);

/// Adds `other`, of the same size, to `plane`.
void add(Plane& plane, const Plane& other);

}  // namespace pharos
