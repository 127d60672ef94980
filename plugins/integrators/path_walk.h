#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <pharos/core/arena.h>
#include <pharos/rendering/scatter_step.h>
#include <pharos/rendering/segment.h>

#include "path_recorder.h"
#include "path_settings.h"
#include "planted_fault.h"

namespace pharos {

/// What one path found.
struct PathSample {
  Rgb radiance;
  Vec2 film;  ///< [pixels]
  Features features;
  bool splat = false;  ///< the camera was guided: `radiance` is a splat's contribution
};

/// One path from the sensor, vertex by vertex:
///
///     first step from the lens -> [ advance -> emission -> next event -> step ] until it ends
///
/// advance() traces a step, resolves the next vertex and only then weights the step, because the
/// density of a guided step may depend on what was hit. `Recorder` listens (path_recorder.h).
template <class Recorder>
class PathWalk {
 public:
  PathWalk(const PathScene& shared, const IterationContext& context, const SampleStream& stream,
           Arena& arena, RenderCounters& counters, Recorder& recorder)
      : shared_(shared),
        scene_(shared.target.scene),
        settings_(shared.settings),
        context_(context),
        stream_(stream),
        arena_(arena),
        counters_(counters),
        tracer_(scene_, counters),
        recorder_(recorder) {}

  /// Runs to the end. `max_depth` bounds the number of segments.
  PathSample run(std::uint16_t max_depth) {
    ++counters_.paths;
    std::optional<ScatterStep> step = first_step();
    while (step && advance(*step)) {
      add_emission();
      if (!goes_on(max_depth)) break;
      begin_scattering();
      if (samples_lights()) add_light_samples();
      step = next_step();
    }
    result_.radiance = radiance_;
    return result_;
  }

  /// Instead of run(): walks to the vertex of this number, so that sample_light() may be called.
  /// False when no light is sampled there.
  bool walk_to_lights(std::uint16_t bounce) {
    std::optional<ScatterStep> step = first_step();
    while (step && advance(*step) && goes_on(settings_.max_depth)) {
      begin_scattering();
      if (bounce_ == bounce) return samples_lights();
      step = next_step();
    }
    return false;
  }

  /// Samples the light of a branch at the primary numbers `u`, from the current vertex.
  void sample_light(std::uint16_t branch, Vec2 u) {
    const float u_choice = shared_.lights.needs_number()
                               ? stream_.get_1d({Purpose::light_choice, bounce_, branch})
                               : 0;
    const int index = shared_.lights.choose(branch, u_choice);
    LightSample light = scene_.lights()[static_cast<std::size_t>(index)]->sample(position(), u);
    if (!planted(PlantedFault::light_choice_forgotten)) {
      light.pdf *= shared_.lights.probability(index);
    }
    if (light.kind == VertexKind::environment) {
      light.point.position = scene_.environment_point(position(), light.direction);
    }
    if (light.pdf > 0) add_light_sample(light);
  }

 private:
  /// A vertex that the path has reached.
  struct Arrival {
    VertexKind kind = VertexKind::sensor;
    SurfacePoint surface;            ///< `position` is valid for volume vertices too
    const Medium* medium = nullptr;  ///< that the path came through
  };

  const Arrival& arrival() const { return arrivals_[current_]; }
  Point3 position() const { return arrival().surface.position; }
  /// Whether the path may have a segment beyond the current vertex.
  bool goes_on(std::uint16_t max_depth) const {
    return arrival().kind != VertexKind::environment && bounce_ < max_depth;
  }
  bool samples_lights() const {
    return settings_.next_event_estimation && !scattering_->purely_discrete();
  }

  // --- the first vertex ----------------------------------------------------------------------

  std::optional<ScatterStep> first_step() {
    const RenderTarget& target = shared_.target;
    const auto pixel = static_cast<int>(stream_.key().index);
    const Vec2 in_pixel = target.jitter ? stream_.get_2d({Purpose::pixel}) : Vec2{0.5f, 0.5f};
    const Vec2 size{static_cast<float>(target.width), static_cast<float>(target.height)};
    result_.film = {static_cast<float>(pixel % target.width) + in_pixel.x,
                    static_cast<float>(pixel / target.width) + in_pixel.y};
    LensPoint lens = target.sensor.sample_lens(stream_.get_2d({Purpose::lens}));
    const Ray ray = target.sensor.ray(lens, {result_.film.x / size.x, result_.film.y / size.y});
    lens.position = ray.origin;
    Arrival& start = arrivals_[current_];
    start.surface.position = lens.position;
    start.surface.normal = lens.normal;
    start.medium = scene_.sensor_medium();
    current_vertex_.position = lens.position;
    current_vertex_.normal = current_vertex_.shading_normal = lens.normal;
    towards_previous_ = lens.normal;
    recorder_.lens(lens, result_.film);
    arena_.reset();

    ScatterStep step{.direction = ray.direction, .event = Event::smooth_reflect};
    step.value = step.unguided_weight = Rgb(1);
    step.unguided_pdf = 1;
    if (context_.guiding == nullptr || !context_.guiding->guides_camera()) return step;
    return guided_first_step(lens, step, size);
  }

  /// Camera guiding: the mixture of uniform film positions and the guide's directions. A path of
  /// any pixel may then land in any other, so all contributions become splats.
  std::optional<ScatterStep> guided_first_step(const LensPoint& lens, ScatterStep step, Vec2 size) {
    const PreparedSensor& sensor = shared_.target.sensor;
    result_.splat = true;
    guidance_ = context_.guiding->query_camera(sensor, lens, arena_);
    const VertexStream stream(stream_, 0);
    if (guidance_.distribution != nullptr &&
        stream.get_1d(Purpose::mix_choice) >= guidance_.unguided_fraction) {
      const std::optional<Proposal> proposal = guidance_.distribution->propose(stream);
      if (!proposal) return std::nullopt;
      step.direction = proposal->direction;
      step.reach = proposal->reach;
      step.distance = proposal->distance;
      step.targets = proposal->targets;
    }
    const std::optional<SensorResponse> response = sensor.response(lens, step.direction);
    if (!response) return std::nullopt;
    result_.film = {response->film.x * size.x, response->film.y * size.y};
    recorder_.film(result_.film);
    step.unguided_pdf = response->direction_pdf;
    const auto pixels = static_cast<float>(shared_.target.window.area());
    step.value = Rgb(response->direction_pdf * pixels);
    step.unguided_weight = Rgb(pixels);
    return step;
  }

  // --- from vertex to vertex ------------------------------------------------------------------

  /// Traces a step to the next vertex and weights it. False when the path ends with value zero.
  bool advance(const ScatterStep& step) {
    const Arrival& from = arrivals_[current_];
    Arrival& to = arrivals_[1 - current_];
    const Ray ray{origin_towards(step.direction), step.direction};
    std::optional<Segment> segment =
        tracer_.trace(ray, medium_towards(step.direction), step, throughput_ * step.value,
                      {stream_, bounce_}, to.surface);
    if (!segment || !contains(step.targets, segment->kind)) return false;
    if (planted(PlantedFault::distance_density_forgotten)) segment->passage.medium_density = 1;
    to.kind = segment->kind;
    to.medium = segment->medium;
    const ResolvedVertex resolved{.direction = step.direction,
                                  .distance = segment->length,
                                  .position = to.surface.position,
                                  .kind = to.kind,
                                  .event = step.event,
                                  .medium_density = segment->passage.medium_density};
    weight_step(step, resolved, segment->passage.transmittance);

    from_position_ = from.surface.position;
    if (vertices_are_asked_for()) {
      previous_ = current_vertex_;
      previous_.event = step.event;
    }
    towards_previous_ = -step.direction;
    current_ = 1 - current_;
    if (++bounce_ == 1) first_throughput_ = max_component(throughput_);
    note_arrival(segment->length);
    return !is_black(throughput_);
  }

  /// Where a ray begins that leaves the current vertex, and the medium that it is in.
  Point3 origin_towards(Vec3 direction) const {
    const bool on_surface = arrival().kind == VertexKind::surface;
    return on_surface ? arrival().surface.origin_towards(direction) : position();
  }
  const Medium* medium_towards(Vec3 direction) const {
    const bool on_surface = arrival().kind == VertexKind::surface;
    return on_surface ? scene_.medium_after(arrival().surface, direction, arrival().medium)
                      : arrival().medium;
  }

  void weight_step(const ScatterStep& step, const ResolvedVertex& resolved, Rgb transmittance) {
    density_ = step_density(guidance_, resolved, step.unguided_pdf);
    const bool plain = guidance_.distribution == nullptr && !scene_.has_media();
    const Rgb weight = plain                ? step.unguided_weight
                       : density_.total > 0 ? step.value * transmittance / density_.total
                                            : Rgb();
    arrived_discretely_ = bounce_ == 0 || is_discrete(step.event);
    throughput_ *= weight;
    recorder_.step(step, density_, guidance_, weight, resolved, transmittance);
  }

  /// `distance` is that of the segment that led here.
  void note_arrival(float distance) {
    const Arrival& here = arrival();
    if (vertices_are_asked_for()) {
      const bool on_surface = here.kind == VertexKind::surface;
      current_vertex_ = {.position = here.surface.position,
                         .normal = on_surface ? here.surface.normal : Vec3{},
                         .shading_normal = on_surface ? here.surface.shading.n : Vec3{},
                         .kind = here.kind};
    }
    if (bounce_ == 1 && here.kind == VertexKind::surface) {
      result_.features = {.albedo = scene_.bsdf(here.surface).albedo(here.surface),
                          .normal = here.surface.shading.n,
                          .depth = distance};
    }
    recorder_.arrival(current_vertex_, throughput_);
  }

  // --- light ----------------------------------------------------------------------------------

  void add_emission() {
    const Arrival& here = arrival();
    if (here.kind == VertexKind::surface) {
      const Light* light = scene_.light_at(here.surface);
      if (light == nullptr) return;
      const Rgb radiance = light->radiance(here.surface, towards_previous_);
      if (is_black(radiance)) return;
      const auto pdf = [&] {
        return shared_.lights.probability(scene_.light_index(here.surface)) *
               light->pdf_point(from_position_, here.surface);
      };
      add_light(radiance, pdf);
    } else if (here.kind == VertexKind::environment) {
      for (const int index : scene_.environment_lights()) {
        const Light& light = *scene_.lights()[static_cast<std::size_t>(index)];
        const auto pdf = [&] {
          return shared_.lights.probability(index) * light.pdf_direction(-towards_previous_);
        };
        add_light(light.environment_radiance(-towards_previous_), pdf);
      }
    }
  }

  /// Emission that the path ran into; `light_pdf()` is next event estimation's density of it.
  template <class LightPdf>
  void add_light(Rgb radiance, LightPdf&& light_pdf) {
    const bool alone = arrived_discretely_ || !settings_.next_event_estimation;
    const float own = planted(PlantedFault::mis_without_guide) ? density_.unguided : density_.total;
    const float weight = alone ? 1.0f : emission_weight(settings_.mis, own, light_pdf());
    radiance_ += weight * throughput_ * radiance;
    recorder_.emission(radiance, weight);
  }

  void add_light_samples() {
    for (std::uint16_t branch = 0; branch < shared_.lights.branches(); ++branch) {
      sample_light(branch, stream_.get_2d({Purpose::light_position, bounce_, branch}));
    }
  }

  void add_light_sample(const LightSample& light) {
    const ScatterValue scatter = scattering_->evaluate(light.direction);
    Rgb value = scatter.value * light.radiance / light.pdf;
    if (is_black(value)) return;
    Ray shadow{origin_towards(light.direction), light.direction, light.distance};
    if (std::isfinite(light.distance)) aim_at(light, shadow);
    const std::optional<Passage> passage =
        pass(shadow, medium_towards(light.direction), throughput_ * scatter.value);
    if (!passage) return;
    value *= passage->transmittance;
    const ResolvedVertex resolved{.direction = light.direction,
                                  .distance = light.distance,
                                  .position = light.point.position,
                                  .kind = light.kind,
                                  .event = scattering_->smooth_event(light.direction),
                                  .medium_density = passage->medium_density};
    // No direction meets a light without extent: its density is for the record alone.
    const bool wants_density = Recorder::kRecords || !light.discrete;
    const StepDensity density =
        wants_density ? step_density(guidance_, resolved, scatter.pdf) : StepDensity{};
    const float weight =
        light.discrete ? 1.0f : light_sample_weight(settings_.mis, light.pdf, density.total);
    radiance_ += weight * throughput_ * value;
    recorder_.light(light, resolved.event, density, weight, weight * value, throughput_);
  }

  std::optional<Passage> pass(const Ray& shadow, const Medium* medium, Rgb throughput) const {
    if (planted(PlantedFault::boundaries_cast_shadows) && scene_.occluded(shadow)) return {};
    return tracer_.pass(shadow, medium, throughput);
  }

  /// Ends a shadow ray just before the light's surface, by as much as surfaces' positions are
  /// uncertain there.
  static void aim_at(const LightSample& light, Ray& shadow) {
    const Vec3 span = light.point.origin_towards(-light.direction) - shadow.origin;
    shadow.t_max = length(span);
    if (shadow.t_max > 0) shadow.direction = span / shadow.t_max;
  }

  // --- scattering -----------------------------------------------------------------------------

  void begin_scattering() {
    const Arrival& here = arrival();
    if (here.kind == VertexKind::surface) {
      scattering_.emplace(here.surface, scene_.bsdf(here.surface), towards_previous_,
                          Transport::radiance);
    } else {
      scattering_.emplace(here.medium->phase_function(), here.medium->scattering(position()),
                          towards_previous_, Transport::radiance);
    }
    guidance_ = {};
    if (!vertices_are_asked_for()) return;
    current_vertex_.roughness = scattering_->roughness();
    if (context_.guiding != nullptr) {
      arena_.reset();
      // The query must live as long as its distribution: both until the next vertex is weighted.
      query_.emplace(GuidingQuery{.previous = &previous_,
                                  .current = current_vertex_,
                                  .towards_previous = towards_previous_,
                                  .transport = Transport::radiance,
                                  .bounce = bounce_,
                                  .scattering = *scattering_,
                                  .medium = here.medium});
      guidance_ = context_.guiding->query(*query_, arena_);
    }
    recorder_.scattering(*scattering_, current_vertex_.roughness, guidance_);
  }

  std::optional<ScatterStep> next_step() {
    std::optional<ScatterStep> step =
        sample_step(*scattering_, guidance_, VertexStream(stream_, bounce_));
    if (!step || settings_.roulette == Roulette::off) return step;
    const bool refracts =
        step->event == Event::smooth_transmit || step->event == Event::discrete_transmit;
    if (refracts) note_refraction();
    if (bounce_ < settings_.roulette_depth) return step;
    const float value = max_component(throughput_) * solid_angle_scale_ / first_throughput_;
    const float survival = std::min(settings_.roulette_limit, value);
    if (stream_.get_1d({Purpose::roulette, bounce_}) >= survival) return std::nullopt;
    if (planted(PlantedFault::roulette_unweighted)) return step;
    step->value *= 1 / survival;
    step->unguided_weight *= 1 / survival;
    return step;
  }

  /// Radiance is compressed into smaller solid angles inside glass; roulette must not take that for
  /// a loss.
  void note_refraction() {
    const float ratio = square(scattering_->bsdf().relative_ior());
    const bool enters = dot(towards_previous_, arrival().surface.normal) > 0;
    solid_angle_scale_ *= enters ? 1 / ratio : ratio;
  }

  /// Whether a guide or a record wants to know vertices.
  bool vertices_are_asked_for() const { return Recorder::kRecords || context_.guiding != nullptr; }

  const PathScene& shared_;
  const Scene& scene_;
  const PathSettings& settings_;
  const IterationContext& context_;
  const SampleStream& stream_;
  Arena& arena_;
  RenderCounters& counters_;
  SegmentTracer tracer_;
  Recorder& recorder_;

  PathSample result_;
  Rgb radiance_;
  Rgb throughput_{1};
  float first_throughput_ = 1;   ///< of the step from the lens, guided or not
  float solid_angle_scale_ = 1;  ///< undoes the compression of radiance by refraction so far
  std::uint16_t bounce_ = 0;     ///< number of the current vertex; 0 on the lens
  // Two arrivals in turn: the scattering at one stays valid until the next has been weighted.
  std::array<Arrival, 2> arrivals_;
  int current_ = 0;
  Vec3 towards_previous_;
  Point3 from_position_;  ///< of the previous vertex
  bool arrived_discretely_ = true;
  StepDensity density_;  ///< of the step that led here
  GuidingVertex previous_, current_vertex_{.kind = VertexKind::sensor};
  std::optional<LocalScattering> scattering_;
  std::optional<GuidingQuery> query_;
  Guidance guidance_;
};

}  // namespace pharos
