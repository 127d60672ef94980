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
  float pdf = 0;  ///< of sample() among smooth events [1/sr]
};

/// A sampled direction.
struct ScatterSample {
  Vec3 direction;             ///< unit, away from the vertex
  Event event = Event::none;  ///< exactly one
  Rgb weight;                 ///< value / pdf [1]
  float pdf = 0;              ///< [1/sr] for smooth events, probability [1] for discrete ones
};

/// One discrete event that is possible at a vertex.
struct DiscreteOutcome {
  Event event = Event::none;
  Vec3 direction;         ///< unit, away from the vertex
  Rgb value;              ///< the share of light that goes this way [1]
  float probability = 0;  ///< that sample() chooses it [1]
};

/// The discrete events of a vertex: none, reflection, transmission, or both, or pass-through.
struct DiscreteOutcomes {
  std::array<DiscreteOutcome, 3> outcomes;
  int count = 0;

  void add(const DiscreteOutcome& o) { outcomes[static_cast<std::size_t>(count++)] = o; }
  const DiscreteOutcome* begin() const { return outcomes.data(); }
  const DiscreteOutcome* end() const { return outcomes.data() + count; }
};

/// How a BSDF is asked.
struct ScatterOptions {
  Transport transport = Transport::radiance;
  /// Only these events take part: values of others are zero, and probabilities are those of a
  /// choice among these alone. A guide that wants "reflection, however" conditions on it so.
  EventMask events = EventMask::all;
};

/// Contract: how a surface scatters light. Thread-safe, free of randomness.
///
/// Protocol: directions are unit vectors in the shading frame (z is the shading normal, x and y are
/// arbitrary unless needs_tangents()) and point away from the surface; `wo` is where the path came
/// from, `wi` where it goes. sample() draws one event and direction; evaluate() gives value and
/// density of the smooth events for a direction; discrete() lists the discrete ones. For every
/// sample `weight == value / pdf`, where value and pdf are those of evaluate() (smooth) or of the
/// listed outcome (discrete). For radiance transport through an interface values include the factor
/// 1/eta^2 of compressed solid angle.
class Bsdf : public Component {
 public:
  static constexpr std::string_view contract_name = "bsdf";

  /// All events that can occur anywhere on the surface. `pass_through` alone says that it is no
  /// surface at all but a boundary of media: all light goes through, and paths have no vertex
  /// there.
  virtual EventMask events() const = 0;

  /// Value f |cos(wi)| [1/sr] and pdf [1/sr] of the smooth events; zero on sides without any.
  virtual ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                                ScatterOptions options) const = 0;

  /// Draws an event and direction from `u_choice` in [0,1) and `u` in [0,1)^2. Empty when nothing
  /// is scattered: a valid sample of value zero.
  virtual std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice,
                                              Vec2 u, ScatterOptions options) const = 0;

  /// The discrete events that are possible for `wo`.
  virtual DiscreteOutcomes discrete(const SurfacePoint&, Vec3, ScatterOptions) const { return {}; }

  /// The smallest roughness of its lobes as a GGX alpha: 0 where events are discrete, 1 for
  /// diffuse scattering.
  virtual float roughness(const SurfacePoint& point) const = 0;

  /// Ratio of refractive indices, outside over inside, 1 for opaque surfaces.
  virtual float relative_ior() const { return 1; }

  /// Approximate fraction of light scattered [1]; for the albedo image.
  virtual Rgb albedo(const SurfacePoint& point) const = 0;

  /// Whether it depends on the directions of x and y, or on SurfacePoint::tangents. Only then are
  /// these along the surface's texture coordinates; it costs time at every hit. BSDFs that contain
  /// others ask for what these ask for.
  virtual bool needs_tangents() const { return false; }

  /// Whether it scatters about another normal than z, as a bump map does. Such a BSDF keeps
  /// radiance, but as with shading normals, importance may gain: its values f |cos(wi)| have the
  /// cosine to that other normal. BSDFs that contain others tilt if one of these does.
  virtual bool tilts_normal() const { return false; }
};

}  // namespace pharos
