#include <algorithm>
#include <cmath>
#include <vector>

#include <pharos/core/parallel.h>
#include <pharos/core/warp.h>
#include <pharos/experiments/pictures/color_map.h>
#include <pharos/experiments/pictures/ellipsoid_picture.h>

namespace pharos {
namespace {

/// The opacity of the ellipsoid with the largest weight. The other opacities are proportional to
/// the square roots of the weights, so that wide faint ellipsoids do not hide the rest.
constexpr float kOpacity = 0.7f;
/// The darkest position on the color map. Ellipsoids are never as dark as the backdrop.
constexpr double kDarkest = 0.3;

/// An ellipsoid, mapped to the unit ball by L^-1 / reach.
class Ellipsoid {
 public:
  /// `share` is the weight divided by the largest weight.
  Ellipsoid(const SpatialGaussian& g, float share)
      : g_(g),
        color_(magma(kDarkest + (1 - kDarkest) * share)),
        opacity_(kOpacity * std::sqrt(share)) {}

  /// The point where a ray enters the ellipsoid, and the cosine between the surface there and the
  /// viewer. The distance is negative if the ray misses.
  struct Hit {
    float distance, cosine, opacity;
    Rgb color;
  };
  Hit hit(const Ray& ray) const {
    const Vec3 v = within(ray.direction), m = within(g_.mean - ray.origin);
    const float a = dot(v, v), b = dot(v, m);
    const float miss = length_squared(cross(v, m)) / a;  // squared distance from the center
    if (miss >= 1) return {-1, 0, 0, {}};
    return {(b - std::sqrt(a * (1 - miss))) / a, std::sqrt(1 - miss), opacity_, color_};
  }

 private:
  /// Returns L^-1 x / reach.
  Vec3 within(Vec3 x) const {
    const std::array<double, 3> z = whitened(g_, {x.x, x.y, x.z});
    return Vec3{static_cast<float>(z[0]), static_cast<float>(z[1]), static_cast<float>(z[2])} /
           kEllipsoidReach;
  }

  SpatialGaussian g_;
  Rgb color_;
  float opacity_;
};

/// A phase function that scatters evenly in all directions.
class EvenScattering final : public PhaseFunction {
 public:
  float evaluate(Vec3, Vec3) const override { return warp::sphere_pdf(); }
  Vec3 sample(Vec3, Vec2 u) const override { return warp::sphere_from_square(u); }
  float mean_cosine() const override { return 0; }
};

}  // namespace

Image ellipsoid_picture(std::span<const SpatialGaussian> components, const CloudView& view,
                        const Image& backdrop) {
  float largest = 0;
  for (const SpatialGaussian& g : components) largest = std::max(largest, g.weight);
  std::vector<Ellipsoid> ellipsoids;
  for (const SpatialGaussian& g : components) {
    ellipsoids.emplace_back(g, g.weight / largest);
  }
  Image picture(view.width, view.height, {"R", "G", "B"});
  parallel_for(static_cast<std::size_t>(view.height), [&](std::size_t row) {
    std::vector<Ellipsoid::Hit> hits;
    for (int x = 0; x < view.width; ++x) {
      const int y = static_cast<int>(row);
      const Ray ray = view.ray((static_cast<float>(x) + 0.5f) / static_cast<float>(view.width),
                               (static_cast<float>(y) + 0.5f) / static_cast<float>(view.height));
      hits.clear();
      for (const Ellipsoid& e : ellipsoids) {
        if (const auto hit = e.hit(ray); hit.distance > 0) hits.push_back(hit);
      }
      std::sort(hits.begin(), hits.end(),
                [](const auto& a, const auto& b) { return a.distance > b.distance; });
      Rgb color = backdrop.rgb(x, y);
      for (const auto& hit : hits) {
        const Rgb shade = (0.25f + 0.75f * hit.cosine) * hit.color;
        color = hit.opacity * shade + (1 - hit.opacity) * color;
      }
      picture.set_rgb(x, y, color);
    }
  });
  return picture;
}

std::span<const SpatialGaussian> mixture_for_picture(const GuidingModel& model, Point3 point,
                                                     Point3 from, Arena& arena) {
  const auto* mixture = dynamic_cast<const SpatialMixture*>(&model);
  if (mixture == nullptr) return {};
  const EvenScattering even;
  const Vec3 way = from - point;
  const Vec3 back = length_squared(way) > 0 ? normalize(way) : Vec3{0, 0, 1};
  const LocalScattering scattering(even, Rgb(1), back, Transport::radiance);
  const GuidingVertex previous{.position = from, .kind = VertexKind::sensor};
  const GuidingVertex current{.position = point, .kind = VertexKind::volume};
  const GuidingQuery query{.previous = &previous,
                           .current = current,
                           .towards_previous = back,
                           .scattering = &scattering,
                           .region = model.place(current).region};
  return mixture->mixture_at(query, arena);
}

}  // namespace pharos
