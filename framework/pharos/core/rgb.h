#pragma once

#include <algorithm>
#include <cmath>

namespace pharos {

/// A linear Rec.709 color: a reflectance [1], or a radiance [W/(m^2 sr)] or related quantity.
struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  explicit constexpr Rgb(float gray) : r(gray), g(gray), b(gray) {}
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

  constexpr float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  constexpr float& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }
  constexpr Rgb& operator+=(Rgb c) { return *this = *this + c; }
  constexpr Rgb& operator*=(Rgb c) { return *this = *this * c; }
  constexpr Rgb& operator*=(float s) { return *this = *this * s; }

  friend constexpr Rgb operator+(Rgb x, Rgb y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
  friend constexpr Rgb operator-(Rgb x, Rgb y) { return {x.r - y.r, x.g - y.g, x.b - y.b}; }
  friend constexpr Rgb operator*(Rgb x, Rgb y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
  friend constexpr Rgb operator/(Rgb x, Rgb y) { return {x.r / y.r, x.g / y.g, x.b / y.b}; }
  friend constexpr Rgb operator*(float s, Rgb c) { return {s * c.r, s * c.g, s * c.b}; }
  friend constexpr Rgb operator*(Rgb c, float s) { return s * c; }
  friend constexpr Rgb operator/(Rgb c, float s) { return (1 / s) * c; }
  friend constexpr bool operator==(Rgb, Rgb) = default;
};

/// Returns the relative luminance of a linear Rec.709 color [unit of the color].
constexpr float luminance(Rgb c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}
constexpr float mean(Rgb c) {
  return (c.r + c.g + c.b) * (1.0f / 3);
}
constexpr float max_component(Rgb c) {
  return std::max(c.r, std::max(c.g, c.b));
}
/// Returns the larger value in each channel.
constexpr Rgb max(Rgb x, Rgb y) {
  return {std::max(x.r, y.r), std::max(x.g, y.g), std::max(x.b, y.b)};
}
constexpr bool is_black(Rgb c) {
  return c.r == 0 && c.g == 0 && c.b == 0;
}
inline bool is_finite(Rgb c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
inline Rgb exp(Rgb c) {
  return {std::exp(c.r), std::exp(c.g), std::exp(c.b)};
}

}  // namespace pharos
