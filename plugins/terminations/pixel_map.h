#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

namespace pharos {

/// A number for each pixel of a window of the film. Positions outside of the window have the number
/// of the nearest pixel.
class PixelMap {
 public:
  explicit PixelMap(const PixelRect& window)
      : PixelMap(window, std::vector<float>(window.area())) {}
  /// Takes the values of all pixels, row by row.
  PixelMap(const PixelRect& window, std::vector<float> values)
      : window_(window), values_(std::move(values)) {}

  /// Returns the index of the pixel that is nearest to a film position [pixels].
  static std::size_t index(const PixelRect& window, Vec2 film) {
    return window.index(std::clamp(static_cast<int>(film.x), window.x0, window.x1 - 1),
                        std::clamp(static_cast<int>(film.y), window.y0, window.y1 - 1));
  }
  /// Returns the number at a film position [pixels].
  float at(Vec2 film) const { return values_[index(window_, film)]; }

  /// Loading requires a window of the same size.
  void archive(Archive& archive) {
    archive(values_);
    bool is_sound = values_.size() == window_.area();
    for (const float value : values_) is_sound &= value >= 0;
    archive.expect(is_sound, "the radiance of pixels");
  }

 private:
  PixelRect window_;
  std::vector<float> values_;
};

}  // namespace pharos
