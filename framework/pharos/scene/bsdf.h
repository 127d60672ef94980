#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/rgb.h>
#include <pharos/scene/events.h>
#include <pharos/scene/surface_point.h>

namespace pharos {

/// Value and density of scattering into a given direction.
struct ScatterValue {
  Rgb value;  ///< f |cos| [1/sr]; at volume vertices sigma_s times the phase function [1/(sr m)]
  float pdf = 0;  ///< density of sample() among smooth events [1/sr]
};

/// A sampled direction.
struct ScatterSample {
  Vec3 direction;             ///< unit, away from the vertex
  Event event = Event::none;  ///< exactly one event
  Rgb weight;                 ///< value / pdf [1]
  float pdf = 0;              ///< [1/sr] for smooth events, probability [1] for discrete ones
};

/// One discrete event that is possible at a vertex.
struct DiscreteOutcome {
  Event event = Event::none;
  Vec3 direction;         ///< unit, away from the vertex
  Rgb value;              ///< fraction of light scattered into this direction [1]
  float probability = 0;  ///< probability that sample() chooses this outcome [1]
};

/// The discrete events of a vertex: none, reflection, transmission, reflection and transmission, or
/// pass-through.
struct DiscreteOutcomes {
  std::array<DiscreteOutcome, 3> outcomes;
  int count = 0;

  void add(const DiscreteOutcome& o) { outcomes[static_cast<std::size_t>(count++)] = o; }
  const DiscreteOutcome* begin() const { return outcomes.data(); }
  const DiscreteOutcome* end() const { return outcomes.data() + count; }
};

/// The conditions under which a BSDF is evaluated or sampled.
struct ScatterOptions {
  Transport transport = Transport::radiance;
  /// Only these events take part. The values of all others are zero, and probabilities refer to a
  /// choice among these events alone. A guide that needs a reflection of any kind restricts the
  /// events in this way.
  EventMask events = EventMask::all;
};

/// Contract: how a surface scatters light. Thread-safe and free of randomness.
///
/// Protocol:
///
/// 1. Directions are unit vectors in the shading frame and point away from the surface. z is the
///    shading normal; x and y are arbitrary unless needs_tangents() is true. `wo` points to the
///    previous path vertex, `wi` to the next one.
/// 2. sample() draws one event and a direction.
/// 3. evaluate() returns the value and the density of the smooth events for a direction.
/// 4. discrete() lists the discrete events.
///
/// Every sample satisfies `weight == value / pdf`. For smooth events, value and pdf are the results
/// of evaluate(). For discrete events, they are the members of the listed outcome. For radiance
/// transport through an interface, values include the factor 1/eta^2, because refraction compresses
/// the solid angle.
class Bsdf : public Component {
 public:
  static constexpr std::string_view contract_name = "bsdf";

  /// All events that can occur anywhere on the surface. A BSDF with `pass_through` alone is only a
  /// boundary of media: all light goes through it, and paths have no vertex there.
  virtual EventMask events() const = 0;

  /// Returns the value f |cos(wi)| [1/sr] and the pdf [1/sr] of the smooth events. Both are zero if
  /// the surface has no smooth events on the side of `wi`.
  virtual ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                ScatterOptions options) const = 0;

  /// Draws an event and a direction from `u_choice` in [0,1) and `u` in [0,1)^2. Returns nothing if
  /// no light is scattered; this is a valid sample of value zero.
  virtual std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                              Vec2 u, ScatterOptions options) const = 0;

  /// Returns the discrete events that are possible for `wo`.
  virtual DiscreteOutcomes discrete(const SurfacePoint&, Vec3, ScatterOptions) const { return {}; }

  /// The smallest roughness of its lobes as a GGX alpha: 0 for discrete events, 1 for diffuse
  /// scattering.
  virtual float roughness(const SurfacePoint& point) const = 0;

  /// The ratio of refractive indices, outside over inside; 1 for opaque surfaces.
  virtual float relative_ior() const { return 1; }

  /// The approximate fraction of light scattered [1], for the albedo image.
  virtual Rgb albedo(const SurfacePoint& point) const = 0;

  /// Whether the BSDF depends on the directions of x and y or on SurfacePoint::tangents. Only then
  /// do x and y follow the surface's texture coordinates, which costs time at every hit. A BSDF
  /// that contains others needs tangents if one of them does.
  virtual bool needs_tangents() const { return false; }

  /// Whether the BSDF scatters about another normal than z, as a bump map does. Its values
  /// f |cos(wi)| then contain the cosine to that other normal. Such a BSDF never increases
  /// radiance, but it may increase importance, as shading normals do. A BSDF that contains others
  /// tilts the normal if one of them does.
  virtual bool tilts_normal() const { return false; }
};

}  // namespace pharos
