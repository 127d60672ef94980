#include <algorithm>

#include <pharos/core/parallel.h>
#include <pharos/experiments/metrics/plane.h>

namespace pharos {
namespace {

/// Adds weight * from[x] to each to[x]. The loop is simple enough for the compiler to vectorize.
void accumulate(float* to, const float* from, float weight, int count) {
  for (int x = 0; x < count; ++x) to[x] += weight * from[x];
}

Plane filtered_rows(const Plane& plane, const Kernel& kernel) {
  Plane result(plane.width, plane.height);
  const int radius = kernel.radius();
  parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t y) {
    const float* row = plane.row(y);
    std::vector<float> padded(plane.width + 2 * radius);
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, plane.width, padded.begin() + radius);
    std::fill_n(padded.end() - radius, radius, row[plane.width - 1]);
    for (int k = 0; k <= 2 * radius; ++k) {
      accumulate(result.row(y), padded.data() + k, kernel.weights[k], plane.width);
    }
  });
  return result;
}

Plane filtered_columns(const Plane& plane, const Kernel& kernel) {
  Plane result(plane.width, plane.height);
  const int radius = kernel.radius();
  parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t y) {
    for (int k = -radius; k <= radius; ++k) {
      const int from = std::clamp(static_cast<int>(y) + k, 0, plane.height - 1);
      accumulate(result.row(y), plane.row(from), kernel.weights[k + radius], plane.width);
    }
  });
  return result;
}

}  // namespace

Plane filtered(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
  return filtered_columns(filtered_rows(plane, along_x), along_y);
}

void add(Plane& plane, const Plane& other) {
  parallel_for(static_cast<std::size_t>(plane.height),
               [&](std::size_t y) { accumulate(plane.row(y), other.row(y), 1, plane.width); });
}

}  // namespace pharos
