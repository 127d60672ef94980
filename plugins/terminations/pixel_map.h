#pragma once

#include <algorithm>
#include <vector>

#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

namespace pharos {

/// A positive number for each pixel of a window of the film: constant and thread-safe.
class PixelMap {
 public:
  /// Takes `value_at(film)` at the center of each pixel [pixels].
  template <class ValueAt>
  PixelMap(const PixelRect& window, ValueAt&& value_at) : window_(window) {
    values_.reserve(window.area());
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const Vec2 center{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
        values_.push_back(static_cast<float>(value_at(center)));
      }
    }
  }
  /// Returns the number of the pixel that is nearest to a film position [pixels].
  float at(Vec2 film) const {
    const int x = std::clamp(static_cast<int>(film.x), window_.x0, window_.x1 - 1);
    const int y = std::clamp(static_cast<int>(film.y), window_.y0, window_.y1 - 1);
    return values_[window_.index(x, y)];
  }

 private:
  PixelRect window_;
  std::vector<float> values_;
};

}  // namespace pharos
