#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pharos {

/// A rectangle of pixels. The upper bounds are exclusive.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t area() const { return static_cast<std::size_t>(width()) * height(); }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  /// Returns the row-major index of a pixel within the rectangle.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * width() + (x - x0);
  }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// Returns the parts of a film's square tiles that lie in `window`, row by row. The tiles have
/// edges of `edge` pixels and begin at the film's corner.
inline std::vector<PixelRect> tiles_of(const PixelRect& window, int edge) {
  std::vector<PixelRect> tiles;
  for (int y = window.y0 / edge * edge; y < window.y1; y += edge) {
    for (int x = window.x0 / edge * edge; x < window.x1; x += edge) {
      tiles.push_back({std::max(x, window.x0), std::max(y, window.y0),
                       std::min(x + edge, window.x1), std::min(y + edge, window.y1)});
    }
  }
  return tiles;
}

}  // namespace pharos
