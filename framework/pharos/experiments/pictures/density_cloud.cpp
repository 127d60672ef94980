#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/density_cloud.h>

namespace pharos {
namespace {

/// The linear brightness of surfaces seen head-on and edge-on. It is dark enough for the cloud to
/// stand out.
constexpr float kHeadOn = 0.16f, kEdgeOn = 0.02f;
/// The exponent that turns the position on the scale into a cloud's opacity. Only the densest parts
/// hide what is behind them.
constexpr double kThinning = 2;
/// Brightness and half the width [pixels] of the box's edges.
constexpr float kEdgeBrightness = 0.25f, kEdgeHalfWidth = 0.75f;

/// Calls `set(x, y)` for every pixel. Rows run concurrently.
template <class Set>
void for_each_pixel(int width, int height, const Set& set) {
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) set(x, static_cast<int>(row));
  });
}

/// Returns the ray through the center of a pixel.
Ray pixel_ray(const CloudView& view, int x, int y) {
  return view.ray((static_cast<float>(x) + 0.5f) / static_cast<float>(view.width),
                  (static_cast<float>(y) + 0.5f) / static_cast<float>(view.height));
}

/// The part of a ray within a box, as distances. It is empty if begin >= end.
struct Stretch {
  float begin, end;
};

Stretch within(const Bounds3& box, const Ray& ray) {
  Stretch all{0, kInfinity};
  for (int axis = 0; axis < 3; ++axis) {
    const float origin = ray.origin[axis], slope = ray.direction[axis];
    if (slope == 0) {
      if (origin < box.low[axis] || origin > box.high[axis]) return {0, 0};
      continue;
    }
    const float a = (box.low[axis] - origin) / slope, b = (box.high[axis] - origin) / slope;
    all.begin = std::max(all.begin, std::min(a, b));
    all.end = std::min(all.end, std::max(a, b));
  }
  return all;
}

/// A view from afar without perspective: a square in space, viewed along its normal.
struct ObliqueSquare {
  explicit ObliqueSquare(const Bounds3& bounds) : center(bounds.center()) {
    constexpr float kMargin = 1.02f;
    edge = kMargin * std::max(bounds.diagonal(), 1e-6f);
  }

  Ray ray(float u, float v) const {
    return {center + edge * ((u - 0.5f) * right + (0.5f - v) * up - forward), forward};
  }
  /// Returns the position of `point` in the picture.
  Vec2 position(Point3 point) const {
    const Vec3 offset = (point - center) / edge;
    return {0.5f + dot(offset, right), 0.5f - dot(offset, up)};
  }

  Point3 center;
  float edge;  ///< [scene units]
  Vec3 forward = normalize(Vec3{-0.45f, -0.4f, -0.8f});
  Vec3 right = normalize(cross(forward, {0, 1, 0}));
  Vec3 up = cross(right, forward);
};

float distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a, offset = p - a;
  const float squared = along.x * along.x + along.y * along.y;
  const float t = squared > 0 ? (offset.x * along.x + offset.y * along.y) / squared : 0;
  const Vec2 nearest = a + std::clamp(t, 0.0f, 1.0f) * along;
  return std::hypot(p.x - nearest.x, p.y - nearest.y);
}

/// Returns the twelve edges of a box in the picture.
std::vector<std::pair<Vec2, Vec2>> projected_edges(const Bounds3& bounds) {
  const ObliqueSquare square(bounds);
  const auto corner = [&](unsigned i) {
    const Bounds3& b = bounds;
    return square.position(
        {(i & 1 ? b.high : b.low).x, (i & 2 ? b.high : b.low).y, (i & 4 ? b.high : b.low).z});
  };
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (unsigned i = 0; i < 8; ++i) {
    for (const unsigned axis : {1u, 2u, 4u}) {
      if ((i & axis) == 0) edges.emplace_back(corner(i), corner(i | axis));
    }
  }
  return edges;
}

}  // namespace

CloudView camera_view(const Scene& scene, int film_width, int film_height, int size) {
  const float scale =
      static_cast<float>(size) / static_cast<float>(std::max(film_width, film_height));
  const auto scaled = [&](int pixels) {
    return std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(pixels))));
  };
  const int width = scaled(film_width), height = scaled(film_height);
  const std::shared_ptr<const PreparedSensor> sensor = scene.sensor().prepare(width, height);
  const LensPoint lens = sensor->sample_lens({0.5f, 0.5f});
  return {width, height, [sensor, lens](float u, float v) { return sensor->ray(lens, {u, v}); }};
}

CloudView oblique_view(const Bounds3& bounds, int size) {
  return {size, size,
          [square = ObliqueSquare(bounds)](float u, float v) { return square.ray(u, v); }};
}

Image cloud_density(const GuidingModel& model, const Bounds3& bounds, const CloudView& view) {
  const float longest_step =
      bounds.diagonal() / static_cast<float>(std::max(view.width, view.height));
  Image image(view.width, view.height, {"Y"});
  for_each_pixel(view.width, view.height, [&](int x, int y) {
    const Ray ray = pixel_ray(view, x, y);
    const Stretch inside = within(bounds, ray);
    if (!(inside.begin < inside.end)) return;
    const float steps = std::ceil((inside.end - inside.begin) / longest_step);
    const float step = (inside.end - inside.begin) / steps;
    double largest = 0;
    for (float i = 0.5f; i < steps; ++i) {
      largest = std::max(largest, model.density(ray.at(inside.begin + i * step)));
    }
    *image.pixel(x, y) = static_cast<float>(largest);
  });
  return image;
}

Image shaded_scene(const Scene& scene, const CloudView& view) {
  Image image(view.width, view.height, {"R", "G", "B"});
  for_each_pixel(view.width, view.height, [&](int x, int y) {
    const Ray ray = pixel_ray(view, x, y);
    SurfacePoint hit;
    if (scene.intersect(ray, hit) == kInfinity) return;
    const float cosine = abs_dot(hit.shading.n, ray.direction);
    image.set_rgb(x, y, Rgb(kEdgeOn + (kHeadOn - kEdgeOn) * cosine));
  });
  return image;
}

Image box_edges(const Bounds3& bounds, int size) {
  const auto edges = projected_edges(bounds);
  const auto pixels = static_cast<float>(size);
  Image image(size, size, {"R", "G", "B"});
  for_each_pixel(size, size, [&](int x, int y) {
    const Vec2 p{(static_cast<float>(x) + 0.5f) / pixels, (static_cast<float>(y) + 0.5f) / pixels};
    float distance = kInfinity;
    for (const auto& [a, b] : edges) distance = std::min(distance, distance_to_segment(p, a, b));
    const float covered = std::clamp(kEdgeHalfWidth + 0.5f - distance * pixels, 0.0f, 1.0f);
    image.set_rgb(x, y, Rgb(kEdgeBrightness * covered));
  });
  return image;
}

Image cloud_picture(const Image& density, const ColorScale& scale, const Image& backdrop) {
  const Image colors = false_color(density, scale);
  Image picture(density.width(), density.height(), {"R", "G", "B"});
  for_each_pixel(density.width(), density.height(), [&](int x, int y) {
    const double position = scale_position(*density.pixel(x, y), scale);
    const auto opacity = static_cast<float>(std::pow(std::clamp(position, 0.0, 1.0), kThinning));
    picture.set_rgb(x, y, opacity * colors.rgb(x, y) + (1 - opacity) * backdrop.rgb(x, y));
  });
  return picture;
}

}  // namespace pharos
