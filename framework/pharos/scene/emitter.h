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
  Vec3 direction;      ///< unit, from the reference point to the light
  float distance = 0;  ///< infinite for the environment [scene units]
  Rgb radiance;   ///< radiance that arrives if nothing is in between [W/(m^2 sr)]; for discrete
                  ///< lights the irradiance at normal incidence [W/m^2]
  float pdf = 0;  ///< [1/sr]; 1 for discrete lights; 0 if nothing can be seen
  bool discrete = false;  ///< a single direction, which no other technique can find
  SurfacePoint point;     ///< on the light (position and normal); for the environment a stand-in
  VertexKind kind = VertexKind::surface;
};

/// Densities of a ray that leaves a light. The origin and the direction are drawn one after the
/// other. A density is 1 if there is only one origin or only one direction.
struct EmissionDensity {
  float position = 0;   ///< [1/m^2]: over the light's surface, or over a plane across the rays if
                        ///< they come from infinitely far away
  float direction = 0;  ///< [1/sr]
};

/// A ray that leaves a light and begins a path there.
struct EmissionSample {
  SurfacePoint point;  ///< on the light (position and normal); for the environment a stand-in, from
                       ///< which the ray crosses the whole scene
  Vec3 direction;      ///< unit, away from the light
  EmissionDensity pdf;  ///< both densities are 0 for a valid sample of value zero
  Rgb weight;  ///< power that the sample represents: radiance times |cos| over both densities [W]
  VertexKind kind = VertexKind::surface;
};

/// A light at its place in a scene. Constant and thread-safe.
class Light {
 public:
  virtual ~Light() = default;

  /// Draws a direction from `from` towards the light.
  virtual LightSample sample(Point3 from, Vec2 u) const = 0;

  /// The density [1/sr] with which sample(from) yields the surface point `point` of this light. It
  /// is 0 for lights without a surface.
  virtual float pdf_point(Point3, const SurfacePoint&) const { return 0; }
  /// The radiance that leaves the surface point `point` towards `direction` [W/(m^2 sr)].
  virtual Rgb radiance(const SurfacePoint&, Vec3) const { return {}; }

  /// Whether rays that leave the scene reach this light.
  virtual bool is_environment() const { return false; }
  /// The density [1/sr] with which sample() yields `direction`. Environment lights only.
  virtual float pdf_direction(Vec3) const { return 0; }
  /// The radiance that arrives from `direction` (pointing away from the scene) [W/(m^2 sr)].
  /// Environment lights only.
  virtual Rgb environment_radiance(Vec3) const { return {}; }

  /// Draws a ray that leaves this light.
  virtual EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const = 0;
  /// The densities with which sample_emission() draws the ray that leaves `point` of this light in
  /// `direction`. If the light is infinitely far away, the ray only passes through `point`. Lights
  /// with a single origin or direction do not check whether `point` or `direction` is that one.
  virtual EmissionDensity pdf_emission(const SurfacePoint& point, Vec3 direction) const = 0;

  /// The emitted power [W], at least roughly. It serves to choose among lights.
  virtual float power() const = 0;
};

/// The place of an emitter in a scene.
struct EmitterSite {
  const Shape* shape = nullptr;  ///< the shape that emits; null if the emitter stands alone
  std::uint32_t object = 0;      ///< index of that shape in Scene::objects()
  Point3 scene_center;     ///< center of the bounding sphere of the scene's geometry [scene units]
  float scene_radius = 1;  ///< its radius, > 0 even in an empty scene [scene units]
};

/// Contract: a source of light.
class Emitter : public Component {
 public:
  static constexpr std::string_view contract_name = "emitter";

  /// Whether the emitter must be given to a shape (area lights) or must stand alone.
  virtual bool needs_shape() const = 0;
  /// Creates the light at `site`. Called once when the scene is built. The result refers to this
  /// emitter and to the shape.
  virtual std::unique_ptr<const Light> place(const EmitterSite& site) const = 0;
};

}  // namespace pharos
