#pragma once

#include <array>

#include <pharos/scene/shape.h>
#include <pharos/scene/texture.h>

namespace pharos {

/// The same color everywhere.
class OneColor final : public Texture {
 public:
  explicit OneColor(Rgb color) : color_(color) {}
  Rgb value_at(const SurfacePoint&) const override { return color_; }
  Rgb maximum() const override { return color_; }
  Rgb average() const override { return color_; }

 private:
  Rgb color_;
};

/// The rectangle [-1,1] x [-2,2] at height 3 that faces down.
class Ceiling final : public Shape {
 public:
  static constexpr std::array<Point3, 4> corners{{{-1, -2, 3}, {-1, 2, 3}, {1, 2, 3}, {1, -2, 3}}};

  Bounds3 bounds() const override { return {{-1, -2, 3}, {1, 2, 3}}; }
  float area() const override { return 8; }
  ShapeSample sample(Vec2 u) const override {
    ShapeSample s{.point = {}, .pdf = 1 / area()};
    s.point.position = {2 * u.x - 1, 4 * u.y - 2, 3};
    s.point.normal = {0, 0, -1};
    s.point.shading = Frame::from_normal(s.point.normal);
    s.point.uv = u;
    return s;
  }
};

}  // namespace pharos
