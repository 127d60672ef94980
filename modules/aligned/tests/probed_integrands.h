#pragma once

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <pharos/sampling/integrand_probe.h>

#include "../probe_grid.h"

/// Integrands with known edges, as probes evaluate them.
namespace pharos::aligned::test {

using Integrand = std::function<float(Vec2)>;

/// Returns an integrand that is one beyond the line through `through` with this normal, and zero
/// before the line.
inline Integrand half_plane(double degrees, Vec2 through) {
  const double angle = degrees * 3.14159265358979323846 / 180;
  const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
  return [=](Vec2 u) { return (u.x - through.x) * x + (u.y - through.y) * y > 0 ? 1.0f : 0.0f; };
}

inline Integrand product(Integrand a, Integrand b) {
  return [a = std::move(a), b = std::move(b)](Vec2 u) { return a(u) * b(u); };
}

inline Integrand disk(Vec2 center, float radius) {
  return [=](Vec2 u) {
    const Vec2 d = u - center;
    return d.x * d.x + d.y * d.y < radius * radius ? 1.0f : 0.0f;
  };
}

/// Returns the values of an integrand at the points of a grid.
inline std::vector<float> values_of(const Integrand& integrand, const ProbeGrid& grid,
                                    std::uint64_t seed) {
  std::vector<float> values;
  for (int tile = 0; tile < grid.tile_count(); ++tile) {
    for (const Vec2 u : grid.points(tile, seed)) values.push_back(integrand(u));
  }
  return values;
}

/// A probe whose integrand is a function of the pixel, the dimension and the two numbers. `hit_at`
/// provides the first hit of each pixel.
class FunctionProbe final : public IntegrandProbe {
 public:
  using Values = std::function<float(int x, int y, Dimension dimension, Vec2 u)>;
  using Hits = std::function<FirstHit(int x, int y)>;

  FunctionProbe(PixelGrid grid, Values value_at, Hits hit_at = {}, int lights = 1)
      : grid_(grid),
        window_{0, 0, grid.width, grid.height},
        value_at_(std::move(value_at)),
        hit_at_(std::move(hit_at)),
        lights_(lights) {}

  PixelGrid grid() const override { return grid_; }
  PixelRect window() const override { return window_; }
  /// Restricts rendering to these pixels.
  void set_window(const PixelRect& window) { window_ = window; }
  int light_branches() const override { return lights_; }
  void evaluate(const ProbeQuery& query, std::span<const Vec2> points,
                std::span<Rgb> values) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      values[i] = Rgb(value_at_(query.x, query.y, query.dimension, points[i]));
    }
  }
  FilmSample whole_path(const ProbeQuery& query, Vec2 point) const override {
    const float value = value_at_(query.x, query.y, query.dimension, point) + kRest;
    return {{static_cast<float>(query.x) + 0.25f, static_cast<float>(query.y) + 0.75f}, Rgb(value)};
  }
  FirstHit first_hit(int x, int y) const override { return hit_at_(x, y); }

  /// The radiance of whole paths in addition to the part that depends on the dimension.
  static constexpr float kRest = 0.5f;

 private:
  PixelGrid grid_;
  PixelRect window_;
  Values value_at_;
  Hits hit_at_;
  int lights_;
};

}  // namespace pharos::aligned::test
