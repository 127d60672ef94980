#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/scene/scene.h>
#include <pharos/scene/texture.h>

/// The smallest parts from which a scene can be made.
namespace pharos::test {

class BlackBsdf : public Bsdf {
 public:
  using Settings = NoSettings;
  explicit BlackBsdf(Settings = {}) {}

  EventMask events() const override { return EventMask::nothing; }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  std::optional<ScatterSample> sample(const SurfacePoint&, Vec3, float, Vec2,
                                      ScatterOptions) const override {
    return std::nullopt;
  }
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint&) const override { return {}; }
};

/// Needs tangents, like brushed metal.
class BrushedBsdf : public BlackBsdf {
 public:
  bool needs_tangents() const override { return true; }
};

class MeshShape : public Shape {
 public:
  explicit MeshShape(TriangleMesh triangles) : mesh_(std::move(triangles)) {}

  Bounds3 bounds() const override { return mesh_.bounds(); }
  float area() const override { return 1; }
  const TriangleMesh* mesh() const override { return &mesh_; }
  ShapeSample sample(Vec2 u) const override { return {mesh_.surface_point(0, u.x, u.y), 1}; }

 private:
  TriangleMesh mesh_;
};

/// An area light or an environment that records where it was placed.
class PlacedEmitter : public Emitter {
 public:
  class PlacedLight : public Light {
   public:
    PlacedLight(bool on_shape, const EmitterSite& where) : site(where), on_shape_(on_shape) {}
    LightSample sample(Point3, Vec2) const override { return {}; }
    bool is_environment() const override { return !on_shape_; }
    EmissionSample sample_emission(Vec2, Vec2) const override { return {}; }
    EmissionDensity pdf_emission(const SurfacePoint&, Vec3) const override { return {}; }
    float power() const override { return 1; }

    EmitterSite site;

   private:
    bool on_shape_;
  };

  explicit PlacedEmitter(bool on_shape) : on_shape_(on_shape) {}
  bool needs_shape() const override { return on_shape_; }
  std::unique_ptr<const Light> place(const EmitterSite& site) const override {
    return std::make_unique<const PlacedLight>(on_shape_, site);
  }

 private:
  bool on_shape_;
};

/// A camera without a view: all rays run along +z.
class PreparedPoint : public PreparedSensor {
 public:
  explicit PreparedPoint(Point3 at) : at_(at) {}
  LensPoint sample_lens(Vec2) const override { return {at_, {0, 0, 1}}; }
  Ray ray(const LensPoint& lens, Vec2) const override { return {lens.position, lens.normal}; }
  std::optional<SensorResponse> response(const LensPoint&, Vec3) const override {
    return std::nullopt;
  }

 private:
  Point3 at_;
};

class PointSensor : public Sensor {
 public:
  explicit PointSensor(Point3 at) : at_(at) {}
  std::unique_ptr<const PreparedSensor> prepare(int, int) const override {
    return std::make_unique<const PreparedPoint>(at_);
  }
  Point3 position() const override { return at_; }

 private:
  Point3 at_;
};

class ClearMedium : public Medium {
 public:
  using Settings = NoSettings;
  explicit ClearMedium(Settings = {}) {}
  DistanceSample sample(const Ray&, Rgb, float, float) const override { return {}; }
  MediumLeg leg(const Ray&, Rgb, float) const override { return {}; }
  Rgb scattering(Point3) const override { return {}; }
  const PhaseFunction& phase_function() const override { std::abort(); }
};

inline SceneObject object_of(Ref<Shape> shape) {
  SceneObject object;
  object.shape = std::move(shape);
  object.bsdf = std::make_shared<const BlackBsdf>();
  return object;
}

inline SceneParts parts_of(std::vector<TriangleMesh> meshes) {
  SceneParts parts;
  for (TriangleMesh& mesh : meshes) {
    parts.objects.push_back(object_of(std::make_shared<const MeshShape>(std::move(mesh))));
  }
  return parts;
}

/// Returns the square [-1,1]^2 at height z. It faces up and consists of triangle 0, below the
/// diagonal, and triangle 1.
inline TriangleMesh square_at(float z) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Returns a bumpy ball about the origin with smooth normals. It is closed, and concave in places.
inline TriangleMesh bumpy_ball(std::uint32_t rings, float scale, Vec3 offset) {
  TriangleMesh mesh;
  const std::uint32_t spokes = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t j = 0; j < spokes; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(spokes);
      const bool pole = i == 0 || i == rings;
      const float s = pole ? 0 : std::sin(theta);
      const Vec3 d{s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
      const float radius = pole ? 1 : 1 + 0.1f * std::sin(9 * phi) * std::sin(7 * theta);
      mesh.positions.push_back(scale * (radius * d + offset));
      mesh.normals.push_back(d);
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * spokes + j % spokes; };
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < spokes; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rings) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  }
  return mesh;
}

inline Vec3 random_direction(RandomStream& random) {
  return normalize(warp::sphere_from_square(random.next_2d()));
}

}  // namespace pharos::test
