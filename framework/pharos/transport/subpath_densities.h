#pragma once

#include <algorithm>
#include <cmath>

#include <pharos/core/arena.h>
#include <pharos/rendering/integrator.h>
#include <pharos/transport/path_vertex.h>
#include <pharos/transport/scatter_step.h>

/// Densities for the balance heuristic over whole paths (Veach 1997, section 10.2). They are those
/// of vertices, in vertex measure: [1/m^2] on surfaces, [1/m^3] in media, [1/sr] for the
/// environment.
///
/// Weights must be the same function of a path whichever way it was made; any such function that
/// adds up to one will do. So densities in here differ from those that paths were drawn with in two
/// things. Distances in media are those of white light, whose channels decide alike, and which
/// media that only absorb stop as well. Discrete events count as their probability times the cosine
/// [1/sr]: the distributions of both ways through a mirror are the same besides, and through glass
/// but for the square of the refractive index.
namespace pharos {

/// A straight way to a vertex.
struct Way {
  ResolvedVertex target;  ///< without event; distances in media by white light
  float cosine = 1;       ///< between the way and the normal at its end; 1 off surfaces [1]

  /// From a density of directions [1/sr] or of directions and distances [1/(sr m)] to one of the
  /// target in vertex measure.
  double to_vertex_measure() const {
    if (target.kind == VertexKind::environment) return 1;
    // Not to be divided by zero, which media draw once in a while.
    return cosine / std::max(double{target.distance} * target.distance, 1e-60);
  }
};

/// The density [1/m] with which white light stops at `target` after losing all but
/// `transmittance`, or [1] gets there.
inline float white_medium_density(const PathVertex& target, Vec3 direction, Rgb transmittance) {
  const float arrives = mean(transmittance);
  if (target.kind != VertexKind::volume) return arrives;
  return arrives * target.medium->scatter_pdf({target.position(), direction},
                                              channel_shares(transmittance), 0);
}

inline Way way_to(const PathVertex& target, Vec3 direction, float distance, Rgb transmittance) {
  return {.target = {.direction = direction,
                     .distance = distance,
                     .position = target.position(),
                     .kind = target.kind,
                     .medium_density = white_medium_density(target, direction, transmittance)},
          .cosine = target.is_on_surface() ? abs_dot(direction, target.surface.normal) : 1};
}

/// What a discrete event's probability is multiplied by to count as a density; 1 for others.
inline double discrete_cosine(const PathVertex& at, Event event, Vec3 direction) {
  return is_discrete(event) ? abs_dot(direction, at.surface.normal) : 1;
}

/// How densely paths of one kind go on from vertices, guides included, wherever these vertices come
/// from: for paths of the other kind, backwards.
class Continuations {
 public:
  /// `guiding` may be null. `arena` is reset by every call.
  Continuations(const Scene& scene, const GuidingFrame* guiding, Transport transport, Arena& arena)
      : scene_(scene), guiding_(guiding), transport_(transport), arena_(arena) {}

  /// The density [1/sr], volume targets [1/(sr m)], of going on to `target` by an event like
  /// `event`, for a path that came to `at` from `before`, which is seen from there in `direction`.
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

/// How densely paths from the lens begin, a guide of first vertices included.
class FirstSteps {
 public:
  /// `guiding` may be null. `arena` is reset by every call.
  FirstSteps(const GuidingFrame* guiding, Arena& arena)
      : guiding_(guiding != nullptr && guiding->guides_camera() ? guiding : nullptr),
        arena_(arena) {}

  /// The density, in vertex measure, of the first vertex that `to` leads to from this point of the
  /// lens, if that of its direction is `direction_pdf` [1/sr] where film positions are uniform.
  double density(const LensPoint& lens, const Way& to, float direction_pdf) const {
    double density = double{direction_pdf} * to.target.medium_density;
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
  const GuidingFrame* guiding_;
  Arena& arena_;
};

/// The product of densities of all vertices of a subpath, backward over forward, but for the last
/// two vertices: what comes next decides on their backward densities.
class SubpathDensities {
 public:
  /// The next vertex, drawn with density `forward`. `backward` is the density with which the one
  /// before the last would be drawn from this one's side, if there is one.
  void extend(double forward, double backward) {
    if (vertices_ >= 2) closed_ *= backward / before_last_;
    before_last_ = last_;
    last_ = forward;
    ++vertices_;
    if (forward > 0) return;
    last_ = 1;
    rule_out();
  }
  /// No path of the other kind makes this one.
  void rule_out() { closed_ = 0; }

  int vertices() const { return vertices_; }
  bool is_ruled_out() const { return closed_ == 0; }
  /// Backward over forward for the whole subpath, of at least one vertex.
  double ratio(double backward_before_last, double backward_last) const {
    if (is_ruled_out()) return 0;
    const double before_last = vertices_ >= 2 ? backward_before_last / before_last_ : 1;
    return closed_ * before_last * (backward_last / last_);
  }

 private:
  double closed_ = 1;
  double before_last_ = 1, last_ = 1;  ///< forward
  int vertices_ = 0;
};

/// The weight [1] of a path by the balance heuristic, for the densities of all other ways to make
/// it over that of the way taken. (0 for infinity, NaN for NaN.)
inline float balance_weight(double others) {
  return static_cast<float>(1 / (1 + others));
}

/// The density, in vertex measure, of light paths that begin at a light of this kind, which is
/// chosen with probability `chosen`. From infinitely far away directions are drawn first.
inline double density_at_light(const EmissionDensity& pdf, VertexKind kind, float chosen) {
  return double{chosen} * (kind == VertexKind::environment ? pdf.direction : pdf.position);
}

/// The density, in vertex measure, with which they go on from there to the vertex that `to` leads
/// to.
inline double density_beyond_light(const EmissionDensity& pdf, VertexKind kind, const Way& to) {
  const double way = kind == VertexKind::environment ? double{pdf.position} * to.cosine
                                                     : pdf.direction * to.to_vertex_measure();
  return way * to.target.medium_density;
}

}  // namespace pharos
