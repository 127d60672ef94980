#pragma once

#include <optional>

#include <pharos/core/vec.h>

namespace pharos {

/// The film as a rectangle about the local view axis +z. Film positions start at the top left. The
/// rectangle's +x is on the left and its +y on top.
class FilmWindow {
 public:
  /// `aspect` is width over height.
  FilmWindow(float half_width, float aspect)
      : half_width_(half_width), half_height_(half_width / aspect) {}

  /// Returns the point of the rectangle at a film position.
  Vec2 point(Vec2 film) const {
    return {(1 - 2 * film.x) * half_width_, (1 - 2 * film.y) * half_height_};
  }
  /// Returns the film position of a point of the rectangle; empty outside the film.
  std::optional<Vec2> film(Vec2 point) const {
    const Vec2 film{(1 - point.x / half_width_) / 2, (1 - point.y / half_height_) / 2};
    if (!(film.x >= 0 && film.x < 1 && film.y >= 0 && film.y < 1)) return std::nullopt;
    return film;
  }
  float area() const { return 4 * half_width_ * half_height_; }

 private:
  float half_width_, half_height_;
};

}  // namespace pharos
