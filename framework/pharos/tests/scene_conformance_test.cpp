// Parts of scenes: a planted fault makes exactly the checks fail that are meant to find it.

#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>

#include <pharos/core/warp.h>
#include <pharos/rendering/filter.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/medium.h>
#include <pharos/scene/sensor.h>
#include <pharos/scene/texture.h>

#include "planted_faults.h"
#include "scene_fixtures.h"

namespace pharos {
namespace {

using test::FaultSettings;
using test::red_with;

// --- emitter -------------------------------------------------------------------------------------

enum class SkyFault { none, pdf, radiance, power, emission, emission_pdf };

/// Emits the same radiance from all directions.
class FaultySky final : public Emitter {
 public:
  using Settings = FaultSettings<SkyFault>;
  explicit FaultySky(const Settings&) : fault_(Settings::planted) {}
  bool needs_shape() const override { return false; }
  std::unique_ptr<const pharos::Light> place(const EmitterSite& site) const override {
    return std::make_unique<const Sky>(fault_, site);
  }

 private:
  class Sky final : public pharos::Light {
   public:
    Sky(SkyFault fault, const EmitterSite& site)
        : fault_(fault), center_(site.scene_center), radius_(site.scene_radius) {}
    LightSample sample(Point3 from, Vec2 u) const override {
      LightSample s{.direction = warp::sphere_from_square(u), .distance = kInfinity};
      s.radiance = Rgb(fault_ == SkyFault::radiance ? 2.1f : 2.0f);
      s.pdf = pdf_direction(s.direction);
      s.point.position = from + 10 * s.direction;
      s.kind = VertexKind::environment;
      return s;
    }
    bool is_environment() const override { return true; }
    float pdf_direction(Vec3) const override {
      return (fault_ == SkyFault::pdf ? 1.03f : 1) * warp::sphere_pdf();
    }
    Rgb environment_radiance(Vec3) const override { return Rgb(2); }
    EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const override {
      const Vec3 towards = warp::sphere_from_square(u_direction);
      Vec2 at = warp::disk_from_square(u_position);
      if (fault_ == SkyFault::emission) at = length(Vec3{at.x, at.y, 0}) * at;
      const Frame frame = Frame::from_normal(towards);
      EmissionSample sample{.direction = -towards, .kind = VertexKind::environment};
      sample.point.position = center_ + radius_ * frame.to_world({at.x, at.y, 1});
      sample.pdf = {1 / (kPi * square(radius_)), warp::sphere_pdf()};
      sample.weight = Rgb(2 / sample.pdf.position / sample.pdf.direction);
      return sample;
    }
    EmissionDensity pdf_emission(const SurfacePoint&, Vec3) const override {
      const float scale = fault_ == SkyFault::emission_pdf ? 1.03f : 1;
      return {scale / (kPi * square(radius_)), warp::sphere_pdf()};
    }
    float power() const override {
      return 8 * kPi * kPi * square(radius_) * (fault_ == SkyFault::power ? 0.3f : 1);
    }

   private:
    SkyFault fault_;
    Point3 center_;
    float radius_;
  };
  SkyFault fault_;
};

TEST_CASE("conformance: faults of an emitter") {
  CHECK(red_with<FaultySky>(SkyFault::none) == "");
  CHECK(red_with<FaultySky>(SkyFault::pdf) == "integral");
  CHECK(red_with<FaultySky>(SkyFault::radiance) == "emission weight");
  CHECK(red_with<FaultySky>(SkyFault::power) == "power");
  CHECK(red_with<FaultySky>(SkyFault::emission) == "emission");
  CHECK(red_with<FaultySky>(SkyFault::emission_pdf) == "emission_density");
}

enum class SpotFault { none, none_far_away, direction, pdf, dark };

/// Emits light from one point into a cone of one degree.
class FaultySpot final : public Emitter {
 public:
  using Settings = FaultSettings<SpotFault>;
  explicit FaultySpot(const Settings&) : fault_(Settings::planted) {}
  bool needs_shape() const override { return false; }
  std::unique_ptr<const pharos::Light> place(const EmitterSite&) const override {
    return std::make_unique<const Spot>(fault_);
  }

 private:
  class Spot final : public pharos::Light {
   public:
    explicit Spot(SpotFault fault) : fault_(fault) {}
    LightSample sample(Point3 from, Vec2 u) const override {
      LightSample s;
      s.point.position = {0, 0, fault_ == SpotFault::none_far_away ? 50.0f : 0.0f};
      const Vec3 away = from - s.point.position;
      const float distance = length(away);
      if (fault_ == SpotFault::dark || !(away.z > kCosine * distance)) return s;
      s.direction = -away / distance;
      if (fault_ == SpotFault::direction) s.direction = normalize(s.direction + Vec3{u.x, 0, 0});
      s.distance = distance;
      s.radiance = Rgb(1 / square(distance));
      s.pdf = fault_ == SpotFault::pdf ? 0.5f : 1.0f;
      s.discrete = true;
      s.kind = VertexKind::light;
      return s;
    }
    EmissionSample sample_emission(Vec2, Vec2 u_direction) const override {
      EmissionSample sample{.kind = VertexKind::light};
      if (fault_ == SpotFault::dark) return sample;
      sample.point.position = {0, 0, fault_ == SpotFault::none_far_away ? 50.0f : 0.0f};
      sample.direction = warp::cone_from_square(u_direction, 1 - kCosine);
      sample.pdf = {1, warp::cone_pdf(1 - kCosine)};
      sample.weight = Rgb(1 / sample.pdf.direction);
      return sample;
    }
    EmissionDensity pdf_emission(const SurfacePoint&, Vec3 direction) const override {
      return {1, direction.z > kCosine ? warp::cone_pdf(1 - kCosine) : 0};
    }
    float power() const override { return 2 * kPi * (1 - kCosine); }

   private:
    static constexpr float kCosine = 0.9998477f;
    SpotFault fault_;
  };
  SpotFault fault_;
};

TEST_CASE("conformance: faults of a narrow spot") {
  CHECK(red_with<FaultySpot>(SpotFault::none) == "");
  CHECK(red_with<FaultySpot>(SpotFault::none_far_away) == "");
  CHECK(red_with<FaultySpot>(SpotFault::direction) == "discrete emission");
  CHECK(red_with<FaultySpot>(SpotFault::pdf) == "discrete emission");
  CHECK(red_with<FaultySpot>(SpotFault::dark) == "power");
}

// --- sensor --------------------------------------------------------------------------------------

enum class SensorFault { none, inverse, pdf, lens, rim, silent, claims_parallel };

/// A thin lens of radius 0.1 that is focused at infinity, so the direction alone determines the
/// film position.
class FaultyLens final : public Sensor {
 public:
  using Settings = FaultSettings<SensorFault>;
  explicit FaultyLens(const Settings&) : fault_(Settings::planted) {}
  std::unique_ptr<const PreparedSensor> prepare(int, int) const override {
    return std::make_unique<const Prepared>(fault_);
  }
  bool sees_one_direction() const override { return fault_ == SensorFault::claims_parallel; }
  Point3 position() const override { return {}; }

 private:
  class Prepared final : public PreparedSensor {
   public:
    explicit Prepared(SensorFault fault) : fault_(fault) {}
    LensPoint sample_lens(Vec2 u) const override {
      Vec2 p = 0.1f * warp::disk_from_square(u);
      const float r = std::hypot(10 * p.x, 10 * p.y);
      if (fault_ == SensorFault::lens) p = r * p;
      if (fault_ == SensorFault::rim && r > 0) p = (1 / r) * p;
      return {{p.x, p.y, 0}, {0, 0, 1}};
    }
    Ray ray(const LensPoint& lens, Vec2 film) const override {
      return {lens.position, normalize({0.5f - film.x, 0.5f - film.y, 1})};
    }
    std::optional<SensorResponse> response(const LensPoint&, Vec3 d) const override {
      if (!(d.z > 0) || fault_ == SensorFault::silent) return std::nullopt;
      Vec2 film{0.5f - d.x / d.z, 0.5f - d.y / d.z};
      if (!(film.x >= 0 && film.x < 1 && film.y >= 0 && film.y < 1)) return std::nullopt;
      if (fault_ == SensorFault::inverse) film.x = 1 - film.x;
      const float z = fault_ == SensorFault::pdf ? 1 : d.z;
      return SensorResponse{film, 1 / (z * d.z * d.z)};
    }

   private:
    SensorFault fault_;
  };
  SensorFault fault_;
};

TEST_CASE("conformance: faults of a sensor") {
  CHECK(red_with<FaultyLens>(SensorFault::none) == "");
  CHECK(red_with<FaultyLens>(SensorFault::inverse) == "connection inverse seen");
  CHECK(red_with<FaultyLens>(SensorFault::lens) == "lens");
  CHECK(red_with<FaultyLens>(SensorFault::rim) == "lens");
  CHECK(red_with<FaultyLens>(SensorFault::silent).find("inverse") != std::string::npos);
  CHECK(red_with<FaultyLens>(SensorFault::claims_parallel) == "inverse");
  CHECK(red_with<FaultyLens>(SensorFault::pdf) == "chi_square connection integral");
}

// --- filter and texture --------------------------------------------------------------------------

enum class FilterFault { none, support, integral, symmetry };

/// A tent filter of radius one.
class FaultyFilter final : public Filter {
 public:
  using Settings = FaultSettings<FilterFault>;
  explicit FaultyFilter(const Settings&) : fault_(Settings::planted) {}
  float radius() const override { return fault_ == FilterFault::support ? 0.9f : 1.0f; }
  float evaluate(Vec2 o) const override {
    const float side = fault_ == FilterFault::symmetry && o.x > 0 && std::abs(o.y) < 1 ? 0.2f : 0;
    const float tent = std::max(0.0f, 1 - std::abs(o.x)) * std::max(0.0f, 1 - std::abs(o.y));
    return tent + side * (o.x < 1 ? o.x - 0.5f : 0);
  }
  float integral() const override { return fault_ == FilterFault::integral ? 1.05f : 1.0f; }

 private:
  FilterFault fault_;
};

TEST_CASE("conformance: faults of a filter") {
  CHECK(red_with<FaultyFilter>(FilterFault::none) == "");
  CHECK(red_with<FaultyFilter>(FilterFault::support) == "integral support");
  CHECK(red_with<FaultyFilter>(FilterFault::integral) == "integral");
  CHECK(red_with<FaultyFilter>(FilterFault::symmetry) == "symmetry");
}

enum class TextureFault { none, range, average, nan };

class FaultyTexture final : public Texture {
 public:
  using Settings = FaultSettings<TextureFault>;
  explicit FaultyTexture(const Settings&) : fault_(Settings::planted) {}
  Rgb value_at(const SurfacePoint& p) const override {
    if (fault_ == TextureFault::nan && std::abs(p.uv.x) > 1e20f)
      return Rgb(std::sqrt(-std::abs(p.uv.x)));
    const float x = p.uv.x - std::floor(p.uv.x);
    return Rgb(x < 0.25f ? 0.8f : 0.4f);
  }
  // Each bound limits its own channel, so the bounds of the other channels still hold.
  Rgb maximum() const override { return {0.8f, fault_ == TextureFault::range ? 0.7f : 0.8f, 0.8f}; }
  Rgb average() const override { return Rgb(fault_ == TextureFault::average ? 0.6f : 0.5f); }

 private:
  TextureFault fault_;
};

TEST_CASE("conformance: faults of a texture") {
  CHECK(red_with<FaultyTexture>(TextureFault::none) == "");
  CHECK(red_with<FaultyTexture>(TextureFault::range) == "range");
  CHECK(red_with<FaultyTexture>(TextureFault::average) == "average");
  CHECK(red_with<FaultyTexture>(TextureFault::nan) == "finite");
}

// --- shape ---------------------------------------------------------------------------------------

enum class ShapeFault { none, area, uniform, solid_angle, bounds };

/// The square [-1,1]^2.
class FaultySquare final : public Shape {
 public:
  using Settings = FaultSettings<ShapeFault>;
  explicit FaultySquare(const Settings&) : fault_(Settings::planted), mesh_(test::square_at(0)) {}

  Bounds3 bounds() const override {
    const float half = fault_ == ShapeFault::bounds ? 0.9f : 1.0f;
    return {{-half, -half, 0}, {half, half, 0}};
  }
  float area() const override { return fault_ == ShapeFault::area ? 4.2f : 4.0f; }
  const TriangleMesh* mesh() const override { return &mesh_; }
  ShapeSample sample(Vec2 u) const override {
    if (fault_ == ShapeFault::uniform) u.x = std::pow(u.x, 1.2f);
    const std::uint32_t upper = u.y > u.x ? 1 : 0;
    // Triangle 0 has the corners (0,0), (1,0), (1,1). Triangle 1 has the corners (0,0), (1,1),
    // (0,1).
    const SurfacePoint p =
        upper ? mesh_.surface_point(1, u.x, u.y - u.x) : mesh_.surface_point(0, u.x - u.y, u.y);
    return {p, 1 / area()};
  }
  float pdf_from(Point3 from, const SurfacePoint& p) const override {
    return Shape::pdf_from(from, p) * (fault_ == ShapeFault::solid_angle ? 1.03f : 1);
  }

 private:
  ShapeFault fault_;
  TriangleMesh mesh_;
};

TEST_CASE("conformance: faults of a shape") {
  CHECK(red_with<FaultySquare>(ShapeFault::none) == "");
  CHECK(red_with<FaultySquare>(ShapeFault::area) == "area solid_angle");
  CHECK(red_with<FaultySquare>(ShapeFault::uniform) == "area solid_angle");
  CHECK(red_with<FaultySquare>(ShapeFault::solid_angle) == "solid_angle");
  CHECK(red_with<FaultySquare>(ShapeFault::bounds) == "bounds");
}
// --- media ---------------------------------------------------------------------------------------

enum class PhaseFault { none, pdf, one_way, mean_cosine, length };

/// An isotropic phase function.
class FaultyPhase final : public PhaseFunction {
 public:
  using Settings = FaultSettings<PhaseFault>;
  explicit FaultyPhase(const Settings&) : fault_(Settings::planted) {}
  float evaluate(Vec3, Vec3 wi) const override {
    if (fault_ == PhaseFault::one_way) return warp::sphere_pdf() * (1 + 0.3f * wi.z);
    return (fault_ == PhaseFault::pdf ? 1.03f : 1) * warp::sphere_pdf();
  }
  Vec3 sample(Vec3, Vec2 u) const override {
    const Vec3 direction = warp::sphere_from_square(u);
    return fault_ == PhaseFault::length ? 1.01f * direction : direction;
  }
  float mean_cosine() const override { return fault_ == PhaseFault::mean_cosine ? 0.1f : 0; }

 private:
  PhaseFault fault_;
};

TEST_CASE("conformance: faults of a phase function") {
  CHECK(red_with<FaultyPhase>(PhaseFault::none) == "");
  CHECK(red_with<FaultyPhase>(PhaseFault::pdf) == "integral");
  CHECK(red_with<FaultyPhase>(PhaseFault::one_way) == "chi_square reciprocity");
  CHECK(red_with<FaultyPhase>(PhaseFault::mean_cosine) == "mean_cosine");
  CHECK(red_with<FaultyPhase>(PhaseFault::length) == "finite");
}

enum class MediumFault { none, scatter_pdf, shares, transmittance, never, beyond, end };

/// A medium that scatters in two channels, in one more than in the other, and not in the third.
class FaultyMedium final : public Medium {
 public:
  using Settings = FaultSettings<MediumFault>;
  explicit FaultyMedium(const Settings&) : fault_(Settings::planted) {}

  DistanceSample sample(const Ray& ray, Rgb shares, float u_channel, float u) const override {
    if (fault_ == MediumFault::never) return {};
    if (fault_ == MediumFault::shares) shares = Rgb(1.0f / 3);
    const int channel = u_channel < shares.r ? 0 : u_channel < shares.r + shares.g ? 1 : 2;
    if (kSigma[channel] == 0) return {};
    if (fault_ == MediumFault::end) {
      // First decides whether the ray passes. The distribution is right.
      u -= std::exp(-kSigma[channel] * ray.t_max);
      if (u < 0) return {};
    }
    const float t = -std::log1p(-u) / kSigma[channel];
    return {t, t < ray.t_max || fault_ == MediumFault::beyond};
  }
  MediumLeg leg(const Ray&, Rgb shares, float t) const override {
    MediumLeg result;
    for (int c = 0; c < 3; ++c) {
      result.transmittance[c] = kSigma[c] > 0 ? std::exp(-kSigma[c] * t) : 1.0f;
    }
    if (fault_ == MediumFault::never) return result;
    const Rgb left = shares * result.transmittance, scattered = left * kSigma;
    result.pass_probability = left.r + left.g + left.b;
    result.scatter_pdf = scattered.r + scattered.g + scattered.b;
    if (fault_ == MediumFault::scatter_pdf) result.scatter_pdf *= 1.03f;
    if (fault_ == MediumFault::transmittance) result.transmittance *= 0.97f;
    return result;
  }
  Rgb scattering(Point3) const override { return kSigma; }
  const PhaseFunction& phase_function() const override { std::abort(); }

 private:
  static constexpr Rgb kSigma{1, 3, 0};
  MediumFault fault_;
};

TEST_CASE("conformance: faults of a medium") {
  CHECK(red_with<FaultyMedium>(MediumFault::none) == "");
  CHECK(red_with<FaultyMedium>(MediumFault::scatter_pdf) == "integral");
  CHECK(red_with<FaultyMedium>(MediumFault::shares) == "chi_square");
  CHECK(red_with<FaultyMedium>(MediumFault::transmittance) == "transmittance");
  CHECK(red_with<FaultyMedium>(MediumFault::never) == "support");
  CHECK(red_with<FaultyMedium>(MediumFault::beyond) == "chi_square end finite");
  CHECK(red_with<FaultyMedium>(MediumFault::end) == "end");
}

}  // namespace
}  // namespace pharos
