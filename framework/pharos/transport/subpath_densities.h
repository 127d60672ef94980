#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/arena.h>
#include <pharos/rendering/integrator.h>
#include <pharos/transport/estimator_rules.h>
#include <pharos/transport/path_vertex.h>
#include <pharos/transport/scatter_step.h>

/// Densities for the balance heuristic over whole paths (Veach 1997, section 10.2). They are
/// densities of vertices, in vertex measure: [1/m^2] on surfaces, [1/m^3] in media, [1/sr] for the
/// environment.
///
/// The weight must be the same function of a path, whichever technique produced it. Any such
/// function is valid if the weights add up to one. The densities here therefore differ from the
/// densities with which paths were drawn in two respects. First, distances in media follow white
/// light: all color channels have the same share, and media that only absorb also stop light.
/// Second, discrete events count as their probability times the cosine [1/sr]. Apart from that, the
/// distributions of both directions through a mirror are the same. For both directions through
/// glass they differ only by the square of the refractive index.
namespace pharos {

/// A straight way to a vertex.
struct Way {
  ResolvedVertex target;  ///< without event; `medium_density` for white light
  float cosine = 1;       ///< between the way and the normal at its end [1]; 1 off surfaces

  /// Returns the factor that converts a density of directions [1/sr], or of directions and
  /// distances [1/(sr m)], to a density of the target in vertex measure.
  double to_vertex_measure() const {
    if (target.kind == VertexKind::environment) return 1;
    // Media occasionally draw the distance zero; the bound avoids a division by zero.
    return cosine / std::max(double{target.distance} * target.distance, 1e-60);
  }
};

/// Returns the density [1/m] with which white light stops at `target` in a medium, or the
/// probability [1] with which it reaches another `target`. `transmittance` is the share of light
/// that is left there.
inline float white_medium_density(const PathVertex& target, Vec3 direction, Rgb transmittance) {
  const float arrives = mean(transmittance);
  if (target.kind != VertexKind::volume) return arrives;
  const MediumLeg there =
      target.medium->leg({target.position(), direction}, channel_shares(transmittance), 0);
  return arrives * there.scatter_pdf;
}

inline Way way_to(const PathVertex& target, Vec3 direction, float distance, Rgb transmittance) {
  return {.target = {.direction = direction,
                     .distance = distance,
                     .position = target.position(),
                     .kind = target.kind,
                     .medium_density = white_medium_density(target, direction, transmittance)},
          .cosine = target.is_on_surface() ? abs_dot(direction, target.surface.normal) : 1};
}

/// Returns the factor that makes the probability of a discrete event count as a density; 1 for
/// other events.
inline double discrete_cosine(const PathVertex& at, Event event, Vec3 direction) {
  return is_discrete(event) ? abs_dot(direction, at.surface.normal) : 1;
}

/// The densities with which paths from one end continue from a vertex, including guides. They are
/// evaluated backwards at vertices of paths from the other end.
class Continuations {
 public:
  /// `guiding` may be null. `arena` is reset by every call.
  Continuations(const Scene& scene, const GuidingFrame* guiding, Transport transport, Arena& arena)
      : scene_(scene), guiding_(guiding), transport_(transport), arena_(arena) {}

  /// Returns the density [1/sr], for volume targets [1/(sr m)], with which a path that came to `at`
  /// from `before` continues to `target`. `direction` points from `at` to `before`. If `event` is
  /// discrete, the path continues by this event; otherwise it continues by a smooth event.
  double density(const PathVertex& at, const GuidingVertex& before, Vec3 direction, Event event,
                 ResolvedVertex target) const {
    const LocalScattering scattering = at.scattering(scene_, direction, transport_);
    target.event = is_discrete(event) ? event : scattering.smooth_event(target.direction);
    const float unguided = is_discrete(event) ? probability(scattering, event)
                                              : scattering.evaluate(target.direction).pdf;
    const float density =
        guiding_ == nullptr
            ? unguided * target.medium_density
            : guided_density(at, before, direction, scattering, target, unguided).total;
    return density * discrete_cosine(at, event, target.direction);
  }

 private:
  static float probability(const LocalScattering& scattering, Event event) {
    for (const DiscreteOutcome& outcome : scattering.discrete()) {
      if (outcome.event == event) return outcome.probability;
    }
    return 0;
  }

  StepDensity guided_density(const PathVertex& at, const GuidingVertex& before, Vec3 direction,
                             const LocalScattering& scattering, const ResolvedVertex& target,
                             float unguided) const {
    arena_.reset();
    GuidingQuery query{.previous = &before,
                       .current = at.described(scattering.roughness()),
                       .towards_previous = direction,
                       .transport = transport_,
                       .bounce = 0,
                       .scattering = &scattering,
                       .medium = at.medium_towards(scene_, direction)};
    return step_density(guiding_->query(query, arena_), target, unguided);
  }

  const Scene& scene_;
  const GuidingFrame* guiding_;
  Transport transport_;
  Arena& arena_;
};

/// The densities with which paths from the lens begin, including guides of the first vertex and
/// the shares of the pixels.
template <class Rules = EstimatorRules>
class FirstSteps {
 public:
  /// `arena` is reset by every call.
  FirstSteps(const RenderTarget& target, const IterationContext& context, Arena& arena)
      : target_(target),
        pixels_(context.pixels),
        guiding_(context.guiding != nullptr && context.guiding->guides_camera() ? context.guiding
                                                                                : nullptr),
        arena_(arena) {}

  /// Returns the density, in vertex measure, of the first vertex, to which `to` leads from this
  /// point of the lens. `seen` is how the sensor sees its direction, with the density for uniform
  /// film positions.
  double density(const LensPoint& lens, const Way& to, const SensorResponse& seen) const {
    const float direction_pdf = seen.direction_pdf;
    const double in_vacuum = Rules::first_density(direction_pdf, share_at(seen.film));
    double density = in_vacuum * to.target.medium_density;
    if (guiding_ != nullptr && direction_pdf > 0) {
      arena_.reset();
      ResolvedVertex first = to.target;
      first.event = Event::smooth_reflect;
      GuidingQuery query{.current = {.position = lens.position,
                                     .normal = lens.normal,
                                     .shading_normal = lens.normal,
                                     .kind = VertexKind::sensor},
                         .towards_previous = lens.normal,
                         .bounce = 0};
      density = step_density(guiding_->query(query, arena_), first, direction_pdf).total;
    }
    return density * to.to_vertex_measure();
  }

 private:
  /// Returns the share of the pixel at a normalized film position [1].
  float share_at(Vec2 film) const {
    if (pixels_ == nullptr || pixels_->are_even()) return 1;
    const PixelRect& window = target_.window;
    const auto x = static_cast<int>(film.x * static_cast<float>(target_.width));
    const auto y = static_cast<int>(film.y * static_cast<float>(target_.height));
    return pixels_->at(std::clamp(x, window.x0, window.x1 - 1),
                       std::clamp(y, window.y0, window.y1 - 1));
  }

  const RenderTarget& target_;
  const PixelShares* pixels_;
  const GuidingFrame* guiding_;
  Arena& arena_;
};

/// The product, over all vertices of a subpath except the last two, of the backward density over
/// the forward density. The backward densities of the last two vertices depend on the vertices that
/// follow.
class SubpathDensities {
 public:
  /// Adds the next vertex, which was drawn with density `forward`. `backward` is the density with
  /// which a path that comes from the new vertex would draw the vertex two before it, if there is
  /// one.
  void extend(double forward, double backward) {
    if (vertices_ >= 2) closed_ *= backward / before_last_;
    before_last_ = last_;
    last_ = forward;
    ++vertices_;
    if (forward > 0) return;
    last_ = 1;
    rule_out();
  }
  /// Marks that no path from the other end can produce this path.
  void rule_out() { closed_ = 0; }

  int vertices() const { return vertices_; }
  bool is_ruled_out() const { return closed_ == 0; }
  /// Returns the backward density over the forward density of the whole subpath, which has at least
  /// one vertex.
  double ratio(double backward_before_last, double backward_last) const {
    if (is_ruled_out()) return 0;
    const double before_last = vertices_ >= 2 ? backward_before_last / before_last_ : 1;
    return closed_ * before_last * (backward_last / last_);
  }

 private:
  double closed_ = 1;
  double before_last_ = 1, last_ = 1;  ///< forward densities
  int vertices_ = 0;
};

/// Returns the MIS weight [1] of a path by the balance heuristic. `others` is the sum of the
/// densities of all other techniques for this path over the density of the technique used.
/// (Infinity gives 0, and NaN gives NaN.)
inline float balance_weight(double others) {
  return static_cast<float>(1 / (1 + others));
}

/// Returns the density, in vertex measure, with which light paths begin at a light of this kind,
/// which is chosen with probability `chosen`. Emission from infinitely far away draws the direction
/// first.
inline double density_at_light(const EmissionDensity& pdf, VertexKind kind, float chosen) {
  return double{chosen} * (kind == VertexKind::environment ? pdf.direction : pdf.position);
}

/// Returns the density, in vertex measure, with which light paths continue from the light to the
/// vertex to which `to` leads.
inline double density_beyond_light(const EmissionDensity& pdf, VertexKind kind, const Way& to) {
  const double way = kind == VertexKind::environment ? double{pdf.position} * to.cosine
                                                     : pdf.direction * to.to_vertex_measure();
  return way * to.target.medium_density;
}

}  // namespace pharos
