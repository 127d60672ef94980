#include <algorithm>
#include <cmath>

#include <pharos/conformance/stage.h>
#include <pharos/core/warp.h>

namespace pharos::conformance {
namespace {

class MattBsdf final : public Bsdf {
 public:
  explicit MattBsdf(float reflectance) : reflectance_(reflectance) {}

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint&, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override {
    if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
    const float pdf = warp::cosine_hemisphere_pdf(wi.z);
    return {Rgb(reflectance_ * pdf), pdf};
  }
  std::optional<ScatterSample> sample(const SurfacePoint&, Vec3 wo, float, Vec2 u,
                                      ScatterOptions options) const override {
    if (wo.z <= 0 || !contains(options.events, Event::smooth_reflect)) return {};
    const Vec3 wi = warp::cosine_hemisphere_from_square(u);
    if (wi.z <= 0) return {};
    return ScatterSample{wi, Event::smooth_reflect, Rgb(reflectance_),
                         warp::cosine_hemisphere_pdf(wi.z)};
  }
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(reflectance_); }

 private:
  float reflectance_;
};

class HalfMirror final : public Bsdf {
 public:
  EventMask events() const override {
    return mask_of(Event::discrete_reflect) | mask_of(Event::pass_through);
  }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2,
                                      ScatterOptions options) const override {
    const DiscreteOutcomes all = discrete(point, wo, options);
    if (all.count == 0) return {};
    const DiscreteOutcome& o = all.outcomes[all.count == 2 && u_choice >= 0.5f ? 1 : 0];
    return ScatterSample{o.direction, o.event, o.value / o.probability, o.probability};
  }
  DiscreteOutcomes discrete(const SurfacePoint&, Vec3 wo, ScatterOptions options) const override {
    const bool reflects = contains(options.events, Event::discrete_reflect);
    const bool passes = contains(options.events, Event::pass_through);
    const float probability = reflects && passes ? 0.5f : 1.0f;
    DiscreteOutcomes all;
    if (reflects) {
      all.add({Event::discrete_reflect, {-wo.x, -wo.y, wo.z}, Rgb(0.5f), probability});
    }
    if (passes) all.add({Event::pass_through, -wo, Rgb(0.5f), probability});
    return all;
  }
  float roughness(const SurfacePoint&) const override { return 0; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(1); }
};

class GlowLight final : public Light {
 public:
  GlowLight(float radiance, const EmitterSite& site) : radiance_(radiance), site_(site) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    const ShapeSample s = site_.shape->sample_from(from, u);
    LightSample sample{.pdf = s.pdf, .point = s.point};
    sample.point.object = site_.object;
    const Vec3 d = s.point.position - from;
    sample.distance = length(d);
    if (!(sample.distance > 0)) return {};
    sample.direction = d / sample.distance;
    sample.radiance = radiance(s.point, -sample.direction);
    return sample;
  }
  float pdf_point(Point3 from, const SurfacePoint& point) const override {
    return site_.shape->pdf_from(from, point);
  }
  Rgb radiance(const SurfacePoint& point, Vec3 direction) const override {
    return dot(direction, point.normal) > 0 ? Rgb(radiance_) : Rgb();
  }
  EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const override {
    const ShapeSample s = site_.shape->sample(u_position);
    const Vec3 local = warp::cosine_hemisphere_from_square(u_direction);
    EmissionSample sample{.point = s.point,
                          .direction = Frame::from_normal(s.point.normal).to_world(local),
                          .pdf = {s.pdf, warp::cosine_hemisphere_pdf(local.z)},
                          .weight = Rgb(kPi * radiance_ / s.pdf)};
    sample.point.object = site_.object;
    return sample;
  }
  EmissionDensity pdf_emission(const SurfacePoint& point, Vec3 direction) const override {
    return {1 / site_.shape->area(), warp::cosine_hemisphere_pdf(dot(direction, point.normal))};
  }
  float power() const override { return kPi * radiance_ * site_.shape->area(); }

 private:
  float radiance_;
  EmitterSite site_;
};

class Glow final : public Emitter {
 public:
  explicit Glow(float radiance) : radiance_(radiance) {}
  bool needs_shape() const override { return true; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override {
    return std::make_unique<const GlowLight>(radiance_, site);
  }

 private:
  float radiance_;
};

/// A pinhole camera with a square film of width one at distance one.
class PreparedPinhole final : public PreparedSensor {
 public:
  explicit PreparedPinhole(Point3 at) : lens_{at, {0, 0, 1}} {}

  LensPoint sample_lens(Vec2) const override { return lens_; }
  Ray ray(const LensPoint& lens, Vec2 film) const override {
    return {lens.position, normalize({0.5f - film.x, 0.5f - film.y, 1})};
  }
  std::optional<SensorResponse> response(const LensPoint&, Vec3 d) const override {
    if (!(d.z > 0)) return std::nullopt;
    const Vec2 film{0.5f - d.x / d.z, 0.5f - d.y / d.z};
    if (!(film.x >= 0 && film.x < 1 && film.y >= 0 && film.y < 1)) return std::nullopt;
    return SensorResponse{film, 1 / (d.z * d.z * d.z)};
  }

 private:
  LensPoint lens_;
};

class Pinhole final : public Sensor {
 public:
  explicit Pinhole(Point3 at) : at_(at) {}
  std::unique_ptr<const PreparedSensor> prepare(int, int) const override {
    return std::make_unique<const PreparedPinhole>(at_);
  }
  Point3 position() const override { return at_; }

 private:
  Point3 at_;
};

class Isotropic final : public PhaseFunction {
 public:
  float evaluate(Vec3, Vec3) const override { return warp::sphere_pdf(); }
  Vec3 sample(Vec3, Vec2 u) const override { return warp::sphere_from_square(u); }
  float mean_cosine() const override { return 0; }
};

class Fog final : public Medium {
 public:
  explicit Fog(float density) : density_(density) {}

  DistanceSample sample(const Ray& ray, Rgb, float, float u) const override {
    const float t = -std::log1p(-u) / density_;
    return {t, t > 0 && t < ray.t_max};
  }
  MediumLeg leg(const Ray&, Rgb, float t) const override {
    const float left = std::exp(-density_ * t);
    return {Rgb(left), left, density_ * left};
  }
  Rgb scattering(Point3) const override { return Rgb(density_); }
  const PhaseFunction& phase_function() const override { return phase_; }

 private:
  float density_;
  Isotropic phase_;
};

}  // namespace

StageShape::StageShape(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  double total = 0;
  for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
    area_up_to_.push_back(total += double{mesh_.area(i)});
  }
  mesh_.precompute();
}

ShapeSample StageShape::sample(Vec2 u) const {
  const double target = u.x * area_up_to_.back();
  const auto chosen = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, target);
  const double below = chosen == area_up_to_.begin() ? 0 : *(chosen - 1);
  const float within = static_cast<float>((target - below) / (*chosen - below));
  const Vec2 b = warp::triangle_from_square({std::min(within, kOneMinusEpsilon), u.y});
  const auto triangle = static_cast<std::uint32_t>(chosen - area_up_to_.begin());
  return {mesh_.surface_point(triangle, b.x, b.y), 1 / area()};
}

TriangleMesh square_mesh(Point3 center, Vec3 u, Vec3 v) {
  TriangleMesh mesh;
  mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TriangleMesh ball_mesh(Point3 center, float radius) {
  constexpr std::uint32_t kRows = 8, kColumns = 12;
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    for (std::uint32_t column = 0; column <= kColumns; ++column) {
      const float u = static_cast<float>(column % kColumns) / kColumns;
      const float theta = kPi * static_cast<float>(row) / kRows;
      const float s = row % kRows == 0 ? 0 : std::sin(theta);
      const Vec3 n{s * std::cos(2 * kPi * u), s * std::sin(2 * kPi * u), std::cos(theta)};
      mesh.positions.push_back(center + radius * n);
      mesh.normals.push_back(n);
      mesh.uvs.push_back({static_cast<float>(column) / kColumns, theta / kPi});
    }
  }
  const auto at = [](std::uint32_t row, std::uint32_t column) {
    return row * (kColumns + 1) + column;
  };
  for (std::uint32_t r = 0; r < kRows; ++r) {
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      if (r + 1 < kRows) mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      if (r > 0) mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
  }
  return mesh;
}

TriangleMesh room_mesh() {
  TriangleMesh room;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {1.0f, -1.0f}) {
      Vec3 n, u, v;
      n[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = -side;  // u x v points inwards
      const TriangleMesh wall = square_mesh(n, u, v);
      const auto first = static_cast<std::uint32_t>(room.positions.size());
      room.positions.insert(room.positions.end(), wall.positions.begin(), wall.positions.end());
      for (const auto& [a, b, c] : wall.triangles) {
        room.triangles.push_back({first + a, first + b, first + c});
      }
    }
  }
  return room;
}

Ref<Bsdf> black_bsdf() {
  return matt_bsdf(0);
}
Ref<Bsdf> matt_bsdf(float reflectance) {
  return std::make_shared<const MattBsdf>(reflectance);
}
Ref<Bsdf> half_mirror() {
  return std::make_shared<const HalfMirror>();
}
Ref<Emitter> glow(float radiance) {
  return std::make_shared<const Glow>(radiance);
}
Ref<Sensor> pinhole(Point3 at) {
  return std::make_shared<const Pinhole>(at);
}
Ref<Medium> fog(float density) {
  return std::make_shared<const Fog>(density);
}

SceneParts alone(Ref<Shape> shape, Ref<Emitter> emitter) {
  SceneParts parts;
  parts.objects.push_back({std::move(shape), black_bsdf(), std::move(emitter), nullptr, nullptr});
  return parts;
}

double sum_along(const Scene& scene, Ray ray,
                 const std::function<double(const SurfacePoint&)>& value) {
  constexpr int kMostHits = 1000;  // a ray that never ends is a fault of the shape
  double sum = 0;
  SurfacePoint point;
  for (int i = 0; i < kMostHits && scene.intersect(ray, point) < kInfinity; ++i) {
    sum += value(point);
    ray.origin = point.origin_towards(ray.direction);
  }
  return sum;
}

bool is_well_seen(Point3 from, const SurfacePoint& point) {
  const Vec3 d = point.position - from;
  return abs_dot(d, point.normal) > 0.1f * length(d);
}

}  // namespace pharos::conformance
