#pragma once

#include <optional>

#include <pharos/rendering/integrator.h>
#include <pharos/transport/estimator_rules.h>
#include <pharos/transport/light_selection.h>
#include <pharos/transport/subpath_densities.h>

/// The paths from the other end that could have produced a path. They are the other techniques of
/// the balance heuristic, and a walk cannot know their densities by itself.
namespace pharos {

/// The choice of lights by both kinds of path.
struct LightChoices {
  const LightSelector& sampled;   ///< lights that are sampled at vertices of paths from the lens
  const LightSelector& emitting;  ///< lights at which paths begin
};

/// The paths from lights that would produce the same path as a path from the lens.
template <class Rules = EstimatorRules>
class LightCounterparts {
 public:
  static constexpr bool kExist = true;

  /// `u_lens` are the random numbers that determine the lens point of the path.
  LightCounterparts(const RenderTarget& target, const LightChoices& lights,
                    const IterationContext& context, Vec2 u_lens, Arena& arena)
      : target_(target),
        scene_(target.scene),
        lights_(lights),
        guiding_(context.guiding),
        u_lens_(u_lens),
        first_steps_(target, context, arena),
        continuations_(target.scene, context.guiding, Transport::importance, arena) {}

  /// Takes note of the step of the path from one vertex to the next.
  void advance(const PathVertex& from, const PathVertex& to, const ScatterStep& step,
               const Guidance& guidance, float length, Rgb transmittance) {
    Way there = way_to(to, step.direction, length, transmittance);
    there.target.event = step.event;
    if (from.kind == VertexKind::sensor) {
      begin(from, to, there);
    } else {
      last_step_ = step_density(guidance, there.target, step.unguided_pdf).total *
                   discrete_cosine(from, step.event, step.direction);
      // Light tracing cannot connect a mirror vertex to the lens: the connection would have to hit
      // one exact direction.
      if (densities_.vertices() == 1 && is_discrete(step.event)) densities_.rule_out();
      densities_.extend(last_step_ * there.to_vertex_measure(),
                        onwards(from, to, step.direction, step.event));
    }
    back_ = way_to(from, -step.direction, length, transmittance);
  }

  /// Returns the MIS weight of emission that the path has hit at `here`. `sampled` is the density
  /// [1/sr] of light samples of this emission; 0 if there are none.
  float of_emission(const Light& light, int index, const PathVertex& here, float sampled) const {
    const EmissionDensity pdf = light.pdf_emission(here.surface, back_.target.direction);
    const double at_light = density_at_light(pdf, here.kind, lights_.emitting.probability(index));
    return balance_weight(sampled / last_step_ +
                          densities_.ratio(density_beyond_light(pdf, here.kind, back_), at_light));
  }

  /// Returns the MIS weight of a light sample at `here`, whose light is scattered by `event`.
  /// `scatter_pdf` is the density [1/sr] with which the BSDF or phase function samples its
  /// direction.
  float of_light_sample(const Light& light, int index, const LightSample& sample, float scatter_pdf,
                        const Guidance& guidance, const PathVertex& here, Event event,
                        Rgb transmittance) const {
    const PathVertex end{.kind = sample.kind, .surface = sample.point};
    Way there = way_to(end, sample.direction, sample.distance, transmittance);
    there.target.event = event;
    const Way back = way_to(here, -sample.direction, sample.distance, transmittance);
    const EmissionDensity pdf = light.pdf_emission(sample.point, -sample.direction);
    const double at_light = density_at_light(pdf, sample.kind, lights_.emitting.probability(index));
    const double ratio = densities_.ratio(onwards(here, end, sample.direction, event),
                                          density_beyond_light(pdf, sample.kind, back)) *
                         at_light;
    if (sample.discrete) return balance_weight(ratio / sample.pdf);
    const double hit = step_density(guidance, there.target, scatter_pdf).total / sample.pdf;
    return balance_weight(hit + ratio / (sample.pdf * there.to_vertex_measure()));
  }

 private:
  /// Adds the first vertex beyond the lens, from which light paths are connected to the lens.
  void begin(const PathVertex& lens, const PathVertex& to, const Way& there) {
    const LensPoint lens_point{lens.position(), lens.surface.normal};
    densities_.extend(first_steps_.density(lens_point, there, seen(lens_point, to, there)), 0);
  }

  /// Returns how the sensor sees the first direction. The density is 0 if it does not.
  SensorResponse seen(const LensPoint& lens, const PathVertex& to, const Way& there) const {
    const PreparedSensor& sensor = target_.sensor;
    if (to.kind == VertexKind::environment) {
      return sensor.response(lens, there.target.direction).value_or(SensorResponse());
    }
    const auto way = sensor.connect(to.position(), u_lens_);
    return way ? way->response() : SensorResponse();
  }

  /// Returns the density, in vertex measure, with which a light path that comes to `at` from
  /// `before` continues to the vertex from which this path came. `direction` points from `at` to
  /// `before`. Returns 0 if this path came from the lens or if no light path can produce it.
  double onwards(const PathVertex& at, const PathVertex& before, Vec3 direction,
                 Event event) const {
    if (densities_.vertices() < 2 || densities_.is_ruled_out()) return 0;
    const float roughness = guiding_ == nullptr ? 1 : before.roughness(scene_);
    return Rules::reverse_density(
        continuations_.density(at, before.described(roughness), direction, event, back_.target) *
        back_.to_vertex_measure());
  }

  const RenderTarget& target_;
  const Scene& scene_;
  LightChoices lights_;
  const GuidingFrame* guiding_;
  Vec2 u_lens_;
  FirstSteps<Rules> first_steps_;
  Continuations continuations_;
  SubpathDensities densities_;
  /// Density of the last step [1/sr], or [1/(sr m)] to a volume vertex. It is not used for steps
  /// from the lens.
  double last_step_ = 1;
  Way back_;  ///< from the last vertex to the previous one
};

/// The paths from the lens that would produce the same path as a path from a light.
class CameraCounterparts {
 public:
  static constexpr bool kExist = true;

  CameraCounterparts(const RenderTarget& target, const LightChoices& lights,
                     const IterationContext& context, Arena& arena)
      : scene_(target.scene),
        lights_(lights),
        guiding_(context.guiding),
        first_steps_(target, context, arena),
        continuations_(target.scene, context.guiding, Transport::radiance, arena) {}

  /// Begins a path with this emission. `before_scene` is the transmittance of media for environment
  /// light on its way to the scene.
  void begin(const Light& light, int index, const EmissionSample& emission, Rgb before_scene) {
    before_scene_ = before_scene;
    light_ = &light;
    index_ = index;
    emission_ = emission;
    runs_into_light_ = emission.kind == VertexKind::environment
                           ? light.is_environment()
                           : emission.kind == VertexKind::surface;
    densities_.extend(
        density_at_light(emission.pdf, emission.kind, lights_.emitting.probability(index)), 0);
  }

  /// Takes note of the step of the path from one vertex to the next.
  void advance(const PathVertex& from, const PathVertex& to, const ScatterStep& step,
               const Guidance& guidance, float length, Rgb transmittance) {
    const bool begins = densities_.vertices() == 1;
    if (begins) transmittance = before_scene_ * transmittance;
    Way there = way_to(to, step.direction, length, transmittance);
    there.target.event = step.event;
    double forward = 0, backward = 0;
    if (begins) {
      forward = density_beyond_light(emission_.pdf, emission_.kind, there);
    } else {
      forward = step_density(guidance, there.target, step.unguided_pdf).total *
                discrete_cosine(from, step.event, step.direction) * there.to_vertex_measure();
      backward = onwards(from, to.described(roughness_of(to)), step.direction, step.event);
    }
    densities_.extend(forward, backward);
    back_ = way_to(from, -step.direction, length, transmittance);
    leads_to_light_ = begins;
    if (begins) begin_backwards(to);
  }

  /// Returns the MIS weight of the light itself at `here`, which is seen from the lens in
  /// `direction`.
  float of_light_seen(const PathVertex& here, const LensPoint& lens, Vec3 direction, float distance,
                      const SensorResponse& seen, Rgb transmittance) const {
    const Way from_lens = way_to(here, direction, distance, transmittance);
    return balance_weight(densities_.ratio(0, first_steps_.density(lens, from_lens, seen)));
  }

  /// Returns the MIS weight of the connection `way` from `here` to the lens. At `here` the light is
  /// scattered towards the lens by `event`.
  float of_connection(const PathVertex& here, const SensorConnection& way, Event event,
                      Rgb transmittance) const {
    const Way from_lens = way_to(here, -way.direction, way.distance, transmittance);
    const PathVertex lens{.surface = {.position = way.lens.position,
                                      .normal = way.lens.normal,
                                      .shading = {.n = way.lens.normal}}};
    const double seen = first_steps_.density(way.lens, from_lens, way.response());
    return balance_weight(
        densities_.ratio(onwards(here, lens.described(), way.direction, event), seen));
  }

 private:
  /// Returns the density, in vertex measure, with which a path from the lens that comes to `at`
  /// from `before` continues to the vertex from which this path came. `direction` points from `at`
  /// to `before`. The density of light samples is included if this path came from the light and
  /// `event` is not discrete.
  double onwards(const PathVertex& at, const GuidingVertex& before, Vec3 direction,
                 Event event) const {
    if (densities_.is_ruled_out()) return 0;
    double density = 0;
    if (!leads_to_light_ || runs_into_light_) {
      density = continuations_.density(at, before, direction, event, back_.target) *
                back_.to_vertex_measure();
    }
    return leads_to_light_ && !is_discrete(event) ? density + sampled_ : density;
  }

  /// Sets `sampled_` and completes `back_` at the first vertex beyond the light.
  void begin_backwards(const PathVertex& to) {
    sampled_ = lights_.sampled.probability(index_);
    if (emission_.kind == VertexKind::surface) {
      sampled_ *= light_->pdf_point(to.position(), emission_.point) * back_.to_vertex_measure();
    } else if (runs_into_light_) {
      sampled_ *= light_->pdf_direction(back_.target.direction);
    }
    if (emission_.kind != VertexKind::environment) return;
    back_.target.distance = kInfinity;
    back_.target.position = scene_.environment_point(to.position(), back_.target.direction);
  }

  float roughness_of(const PathVertex& vertex) const {
    return guiding_ == nullptr ? 1 : vertex.roughness(scene_);
  }

  const Scene& scene_;
  LightChoices lights_;
  const GuidingFrame* guiding_;
  FirstSteps<> first_steps_;
  Continuations continuations_;
  SubpathDensities densities_;
  const Light* light_ = nullptr;
  int index_ = 0;
  EmissionSample emission_;
  Rgb before_scene_{1};
  bool runs_into_light_ = false;  ///< whether steps can hit the light
  bool leads_to_light_ = false;   ///< whether `back_` leads to the light
  double sampled_ = 0;  ///< density of light samples in the measure of the vertex on the light
  Way back_;            ///< from the last vertex to the previous one
};

}  // namespace pharos
