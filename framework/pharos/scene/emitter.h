#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/bounds.h>
#include <pharos/core/rgb.h>
#include <pharos/scene/events.h>
#include <pharos/scene/shape.h>
#include <pharos/scene/surface_point.h>

namespace pharos {

/// A direction towards a light, drawn for next event estimation from a reference point.
struct LightSample {
  Vec3 direction;         ///< unit, from the reference point to the light
  float distance = 0;     ///< infinite for the environment [scene units]
  Rgb radiance;           ///< arriving if nothing is in between [W/(m^2 sr)]; irradiance at normal
                          ///< incidence [W/m^2] for discrete lights
  float pdf = 0;          ///< [1/sr]; 1 for discrete lights; 0 when nothing can be seen
  bool discrete = false;  ///< a single direction: no other technique can find this light
  SurfacePoint point;     ///< on the light (position and normal; a stand-in for the environment)
  VertexKind kind = VertexKind::surface;
};

/// Densities of a ray that leaves a light: of where it begins and of its direction, which are drawn
/// one after the other. Each is 1 where there is but one.
struct EmissionDensity {
  float position = 0;  ///< [1/m^2]: on the light's surface, or across rays from infinitely far away
  float direction = 0;  ///< [1/sr]
};

/// A ray of light as it leaves a light, for paths that begin there.
struct EmissionSample {
  SurfacePoint point;  ///< on the light (position and normal); a stand-in for the environment, from
                       ///< which the ray crosses the whole scene
  Vec3 direction;      ///< unit, away from the light
  EmissionDensity pdf;  ///< 0 in both for a valid sample of value zero
  Rgb weight;  ///< power that the sample stands for: radiance times |cos| over both densities [W]
  VertexKind kind = VertexKind::surface;
};

/// A light as it stands in a scene: constant, thread-safe.
class Light {
 public:
  virtual ~Light() = default;

  /// Draws a direction from `from` towards the light.
  virtual LightSample sample(Point3 from, Vec2 u) const = 0;

  /// The density [1/sr] with which sample(from) yields the surface point `point` of this light.
  /// 0 for lights without surface.
  virtual float pdf_point(Point3, const SurfacePoint&) const { return 0; }
  /// Radiance leaving the surface point `point` towards `direction` [W/(m^2 sr)].
  virtual Rgb radiance(const SurfacePoint&, Vec3) const { return {}; }

  /// Whether rays that leave the scene meet this light.
  virtual bool is_environment() const { return false; }
  /// The density [1/sr] with which sample() yields `direction`; environment lights only.
  virtual float pdf_direction(Vec3) const { return 0; }
  /// Radiance arriving from `direction` (pointing away from the scene); environment lights only.
  virtual Rgb environment_radiance(Vec3) const { return {}; }

  /// Draws a ray that leaves this light.
  virtual EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const = 0;
  /// The densities with which sample_emission() draws the ray that leaves `point` of this light (or
  /// passes there, if it comes from infinitely far away) into `direction`. Lights of a single point
  /// or direction are not asked whether it is that one.
  virtual EmissionDensity pdf_emission(const SurfacePoint& point, Vec3 direction) const = 0;

  /// Emitted power, at least roughly [W]; for choosing among lights.
  virtual float power() const = 0;
};

/// Where an emitter stands.
struct EmitterSite {
  const Shape* shape = nullptr;  ///< the shape it was given to; null when it stands alone
  std::uint32_t object = 0;      ///< index into Scene::objects() of that shape
  Point3 scene_center;           ///< bounding sphere of the scene's geometry [scene units]
  float scene_radius = 1;        ///< > 0, even in an empty scene [scene units]
};

/// Contract: a source of light.
class Emitter : public Component {
 public:
  static constexpr std::string_view contract_name = "emitter";

  /// Whether it must be given to a shape (area lights) or must stand alone.
  virtual bool needs_shape() const = 0;
  /// The light at `site`; called once when the scene is built. The result refers to this emitter
  /// and to the shape.
  virtual std::unique_ptr<const Light> place(const EmitterSite& site) const = 0;
};

}  // namespace pharos
