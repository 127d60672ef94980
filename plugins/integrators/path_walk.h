#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <pharos/core/arena.h>
#include <pharos/rendering/segment.h>

#include "counterparts.h"
#include "path_recorder.h"
#include "path_settings.h"
#include "planted_fault.h"
#include "unit_paths.h"

namespace pharos {

/// One path from the sensor, vertex by vertex:
///
///     first step from the lens -> [ advance -> emission -> next event -> step ] until it ends
///
/// advance() traces a step, resolves the next vertex and only then weights the step, because the
/// density of a guided step may depend on what was hit. `Recorder` listens (path_recorder.h); it is
/// told weights between stepping and light sampling alone. `Counterparts` know what else could have
/// made the path.
template <class Recorder, class Counterparts = NoCounterparts>
class PathWalk {
 public:
  PathWalk(const PathScene& shared, const IterationContext& context, const SampleStream& stream,
           Arena& arena, RenderCounters& counters, Recorder& recorder,
           Counterparts counterparts = {})
      : shared_(shared),
        scene_(shared.target.scene),
        settings_(shared.settings),
        context_(context),
        stream_(stream),
        arena_(arena),
        counters_(counters),
        tracer_(scene_, counters),
        recorder_(recorder),
        counterparts_(std::move(counterparts)) {}

  /// Runs to the end. `max_depth` bounds the number of segments.
  PathSample run(std::uint16_t max_depth) {
    ++counters_.paths;
    ScatterStep step;
    bool goes = first_step(step);
    while (goes && advance(step)) {
      add_emission();
      if (!goes_on(max_depth)) break;
      begin_scattering();
      if (samples_lights()) add_light_samples();
      goes = next_step(step);
    }
    result_.radiance = radiance_;
    return result_;
  }

  /// Instead of run(): walks to the vertex of this number, so that sample_light() may be called.
  /// False when no light is sampled there.
  bool walk_to_lights(std::uint16_t bounce) {
    ScatterStep step;
    bool goes = first_step(step);
    while (goes && advance(step) && goes_on(settings_.max_depth)) {
      begin_scattering();
      if (bounce_ == bounce) return samples_lights();
      goes = next_step(step);
    }
    return false;
  }

  /// Samples the light of a branch at the primary numbers `u`, from the current vertex.
  void sample_light(std::uint16_t branch, Vec2 u) {
    const float u_choice = shared_.lights.needs_number()
                               ? stream_.get_1d({Purpose::light_choice, bounce_, branch})
                               : 0;
    const int index = shared_.lights.choose(branch, u_choice);
    const Light& emitter = *scene_.lights()[static_cast<std::size_t>(index)];
    LightSample light = emitter.sample(position(), u);
    if (!planted(PlantedFault::light_choice_forgotten)) {
      light.pdf *= shared_.lights.probability(index);
    }
    if (light.kind == VertexKind::environment) {
      light.point.position = scene_.environment_point(position(), light.direction);
    }
    if (light.pdf > 0) add_light_sample(emitter, index, light);
  }

 private:
  const PathVertex& arrival() const { return arrivals_[current_]; }
  Point3 position() const { return arrival().position(); }
  /// Whether the path may have a segment beyond the current vertex.
  bool goes_on(std::uint16_t max_depth) const {
    return arrival().kind != VertexKind::environment && bounce_ < max_depth;
  }
  bool samples_lights() const {
    return settings_.next_event_estimation && !scattering_->purely_discrete();
  }

  // --- the first vertex ----------------------------------------------------------------------

  bool first_step(ScatterStep& step) {
    const RenderTarget& target = shared_.target;
    const auto pixel = static_cast<int>(stream_.key().index);
    const Vec2 in_pixel = target.jitter ? stream_.get_2d({Purpose::pixel}) : Vec2{0.5f, 0.5f};
    const Vec2 size{static_cast<float>(target.width), static_cast<float>(target.height)};
    result_.film = {static_cast<float>(pixel % target.width) + in_pixel.x,
                    static_cast<float>(pixel / target.width) + in_pixel.y};
    LensPoint lens = target.sensor.sample_lens(stream_.get_2d({Purpose::lens}));
    const Ray ray = target.sensor.ray(lens, {result_.film.x / size.x, result_.film.y / size.y});
    lens.position = ray.origin;
    PathVertex& start = arrivals_[current_];
    start.surface.position = lens.position;
    start.surface.normal = lens.normal;
    start.medium = scene_.sensor_medium();
    start.surface.shading.n = lens.normal;
    current_vertex_ = start.described();
    towards_previous_ = lens.normal;
    recorder_.lens(lens, result_.film);
    arena_.reset();

    step.direction = ray.direction;
    step.event = Event::smooth_reflect;
    step.value = step.unguided_weight = Rgb(1);
    step.unguided_pdf = 1;
    if (context_.guiding == nullptr || !context_.guiding->guides_camera()) return true;
    return guide_first_step(lens, size, step);
  }

  GuidingQuery lens_query(const LensPoint& lens) const {
    return {.current = current_vertex_, .towards_previous = lens.normal, .bounce = 0};
  }

  /// Camera guiding: the mixture of uniform film positions and the guide's directions. A path of
  /// any pixel may then land in any other, so all contributions become splats.
  bool guide_first_step(const LensPoint& lens, Vec2 size, ScatterStep& step) {
    const PreparedSensor& sensor = shared_.target.sensor;
    result_.splat = true;
    query_.emplace(lens_query(lens));
    guidance_ = context_.guiding->query(*query_, arena_);
    const VertexStream stream(stream_, 0);
    if (guidance_.is_guided() && stream.get_1d(Purpose::mix_choice) >= guidance_.unguided_share) {
      const std::optional<Proposal> proposal = guidance_.propose(stream);
      if (!proposal) return false;
      step.direction = proposal->direction;
      step.reach = proposal->reach;
      step.distance = proposal->distance;
      step.targets = proposal->targets;
      step.within = proposal->within;
    }
    const std::optional<SensorResponse> response = sensor.response(lens, step.direction);
    if (!response) return false;
    result_.film = {response->film.x * size.x, response->film.y * size.y};
    recorder_.film(result_.film);
    step.unguided_pdf = response->direction_pdf;
    step.value = Rgb(response->direction_pdf);
    return true;
  }

  // --- from vertex to vertex ------------------------------------------------------------------

  /// Traces a step to the next vertex and weights it. False when the path ends with value zero.
  bool advance(const ScatterStep& step) {
    const PathVertex& from = arrivals_[current_];
    PathVertex& to = arrivals_[1 - current_];
    const Ray ray{from.origin_towards(step.direction), step.direction};
    Segment segment;
    const bool arrives =
        tracer_.trace(ray, from.medium_towards(scene_, step.direction), step,
                      throughput_ * step.value, {stream_, bounce_}, segment, to.surface);
    if (!arrives || !step.accepts(segment.kind, to.position())) return false;
    Passage& passage = segment.passage;
    if (planted(PlantedFault::distance_density_forgotten)) passage.medium_density = 1;
    to.kind = segment.kind;
    to.medium = segment.medium;
    const ResolvedVertex resolved{.direction = step.direction,
                                  .distance = segment.length,
                                  .position = to.surface.position,
                                  .kind = to.kind,
                                  .event = step.event,
                                  .medium_density = passage.medium_density};
    weight_step(step, resolved, passage.transmittance);
    if (planted(PlantedFault::boundaries_count_as_origins)) {
      density_.total /= passage.medium_density;
    }
    if constexpr (Counterparts::kExist) {
      counterparts_.advance(from, to, step, guidance_, segment.length, passage.transmittance);
    }

    if (vertices_are_asked_for()) {
      previous_ = current_vertex_;
      if (!Counterparts::kExist) previous_.event = step.event;
    }
    towards_previous_ = -step.direction;
    current_ = 1 - current_;
    if (++bounce_ == 1) first_throughput_ = max_component(throughput_);
    note_arrival(segment.length);
    return !is_black(throughput_);
  }

  void weight_step(const ScatterStep& step, const ResolvedVertex& resolved, Rgb transmittance) {
    density_ = step_density(guidance_, resolved, step.unguided_pdf);
    const bool plain = !guidance_.is_guided() && !scene_.has_media();
    Rgb weight = plain                ? step.unguided_weight
                 : density_.total > 0 ? step.value * transmittance / density_.total
                                      : Rgb();
    weight *= step.continuation;
    arrived_discretely_ = bounce_ == 0 || is_discrete(step.event);
    throughput_ *= weight;
    recorder_.step(step, density_, guidance_, weight, resolved, transmittance);
  }

  /// `distance` is that of the segment that led here.
  void note_arrival(float distance) {
    const PathVertex& here = arrival();
    if (vertices_are_asked_for()) current_vertex_ = here.described();
    if (bounce_ == 1 && here.kind == VertexKind::surface) {
      result_.features = {.albedo = scene_.bsdf(here.surface).albedo(here.surface),
                          .normal = here.surface.shading.n,
                          .depth = distance};
    }
    recorder_.arrival(current_vertex_, throughput_);
  }

  // --- light ----------------------------------------------------------------------------------

  void add_emission() {
    const PathVertex& here = arrival();
    if (here.kind == VertexKind::surface) {
      const Light* light = scene_.light_at(here.surface);
      if (light == nullptr) return;
      const Rgb radiance = light->radiance(here.surface, towards_previous_);
      if (is_black(radiance)) return;
      add_light(*light, scene_.light_index(here.surface), radiance,
                [&] { return light->pdf_point(step_origin(), here.surface); });
    } else if (here.kind == VertexKind::environment) {
      for (const int index : scene_.environment_lights()) {
        const Light& light = *scene_.lights()[static_cast<std::size_t>(index)];
        add_light(light, index, light.environment_radiance(-towards_previous_),
                  [&] { return light.pdf_direction(-towards_previous_); });
      }
    }
  }

  /// Where the step began that light was run into by.
  Point3 step_origin() const {
    const Point3 from = arrivals_[1 - current_].position();
    return planted(PlantedFault::boundaries_count_as_origins)
               ? last_boundary(scene_, from, arrival().surface)
               : from;
  }

  /// Emission that the path ran into; `light_pdf()` is next event estimation's density of it, but
  /// for the choice of the light.
  template <class LightPdf>
  void add_light(const Light& light, int index, Rgb radiance, LightPdf&& light_pdf) {
    const bool alone = arrived_discretely_ || !settings_.next_event_estimation;
    const float own = planted(PlantedFault::mis_without_guide) ? density_.unguided : density_.total;
    const float sampled = alone ? 0.0f : shared_.lights.probability(index) * light_pdf();
    const float weight = alone ? 1.0f : emission_weight(settings_.mis, own, sampled);
    float whole_weight = weight;
    if constexpr (Counterparts::kExist) {
      if (is_black(radiance)) return;
      whole_weight = counterparts_.of_emission(light, index, arrival(), sampled);
    }
    radiance_ += whole_weight * throughput_ * radiance;
    recorder_.emission(radiance, {weight, whole_weight});
  }

  void add_light_samples() {
    for (std::uint16_t branch = 0; branch < shared_.lights.branches(); ++branch) {
      sample_light(branch, stream_.get_2d({Purpose::light_position, bounce_, branch}));
    }
  }

  void add_light_sample(const Light& emitter, int index, const LightSample& light) {
    const ScatterValue scatter = scattering_->evaluate(light.direction);
    Rgb value = scatter.value * light.radiance / light.pdf;
    if (is_black(value)) return;
    Ray shadow{arrival().origin_towards(light.direction), light.direction, light.distance};
    // Ends just before the light's surface, by as much as positions are uncertain there.
    if (std::isfinite(light.distance)) {
      shadow =
          ray_between(shadow.origin, light.point.origin_towards(-light.direction), light.direction);
    }
    Passage passage;
    if (!pass(shadow, arrival().medium_towards(scene_, light.direction),
              throughput_ * scatter.value, passage)) {
      return;
    }
    value *= passage.transmittance;
    const ResolvedVertex resolved{.direction = light.direction,
                                  .distance = light.distance,
                                  .position = light.point.position,
                                  .kind = light.kind,
                                  .event = scattering_->smooth_event(light.direction),
                                  .medium_density = passage.medium_density};
    // No step can hit a light without extent.
    const StepDensity density =
        light.discrete ? StepDensity{} : step_density(guidance_, resolved, scatter.pdf);
    const bool in_empty_space = planted(PlantedFault::boundaries_count_as_origins);
    const float step_pdf = in_empty_space ? density.total / passage.medium_density : density.total;
    const float weight =
        light.discrete ? 1.0f : light_sample_weight(settings_.mis, light.pdf, step_pdf);
    float whole_weight = weight;
    if constexpr (Counterparts::kExist) {
      whole_weight =
          counterparts_.of_light_sample(emitter, index, light, scatter.pdf, guidance_, arrival(),
                                        resolved.event, passage.transmittance);
    }
    radiance_ += whole_weight * throughput_ * value;
    recorder_.light(light, resolved.event, {weight, whole_weight}, value, throughput_);
  }

  bool pass(const Ray& shadow, const Medium* medium, Rgb throughput, Passage& passage) const {
    if (planted(PlantedFault::boundaries_cast_shadows) && scene_.occluded(shadow)) return false;
    return tracer_.pass(shadow, medium, throughput, passage);
  }

  // --- scattering -----------------------------------------------------------------------------

  void begin_scattering() {
    const PathVertex& here = arrival();
    scattering_.emplace(here.scattering(scene_, towards_previous_, Transport::radiance));
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
                                  .bounce = Counterparts::kExist ? std::uint16_t{0} : bounce_,
                                  .scattering = &*scattering_,
                                  .medium = here.medium});
      guidance_ = context_.guiding->query(*query_, arena_);
    }
    recorder_.scattering(*scattering_, current_vertex_.roughness, guidance_);
  }

  bool next_step(ScatterStep& step) {
    if (!sample_step(*scattering_, guidance_, VertexStream(stream_, bounce_), step)) return false;
    if (settings_.roulette == Roulette::off) return true;
    const bool refracts =
        step.event == Event::smooth_transmit || step.event == Event::discrete_transmit;
    if (refracts) note_refraction();
    if (bounce_ < settings_.roulette_depth) return true;
    const float value = max_component(throughput_) * solid_angle_scale_ / first_throughput_;
    const float survival = std::min(settings_.roulette_limit, value);
    if (stream_.get_1d({Purpose::roulette, bounce_}) >= survival) return false;
    if (planted(PlantedFault::roulette_unweighted)) return true;
    step.continuation = 1 / survival;
    return true;
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
  [[no_unique_address]] Counterparts counterparts_;

  PathSample result_;
  Rgb radiance_;
  Rgb throughput_{1};
  float first_throughput_ = 1;   ///< of the step from the lens, guided or not
  float solid_angle_scale_ = 1;  ///< undoes the compression of radiance by refraction so far
  std::uint16_t bounce_ = 0;     ///< number of the current vertex; 0 on the lens
  // Two arrivals in turn: the scattering at one stays valid until the next has been weighted.
  std::array<PathVertex, 2> arrivals_;
  int current_ = 0;
  Vec3 towards_previous_;
  bool arrived_discretely_ = true;
  StepDensity density_;  ///< of the step that led here
  GuidingVertex previous_, current_vertex_{.kind = VertexKind::sensor};
  std::optional<LocalScattering> scattering_;
  std::optional<GuidingQuery> query_;
  Guidance guidance_;
};

}  // namespace pharos
