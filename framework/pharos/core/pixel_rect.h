#pragma once

#include <cstddef>

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

}  // namespace pharos
