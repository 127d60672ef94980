#pragma once

#include <array>
#include <optional>
#include <utility>

#include <pharos/core/arena.h>
#include <pharos/rendering/segment.h>

#include "counterparts.h"
#include "planted_fault.h"

namespace pharos {

/// What every light path of a render shares.
struct LightScene {
  const RenderTarget& target;
  const LightSelector& lights;     ///< of which one is chosen by its power
  std::uint16_t max_depth;         ///< segments, that to the lens included
  std::uint16_t first_bounce = 0;  ///< number of the light's vertex in the stream's dimensions
};

/// What a LightWalk reports to, call by call along the path; others replace what they want to hear.
struct SilentLightListener {
  /// A vertex is reached, that on the light too.
  void arrive(const PathVertex&, Rgb /*throughput*/) {}
  /// The step from the last vertex, with its f/p.
  void step(const ScatterStep&, Rgb /*weight*/) {}
  /// The lens sees the last vertex, which scatters light there by the event: f/p without
  /// throughput, part of the mean over all pixels, and its MIS weight.
  void connection(const LensPoint&, Vec3 /*direction*/, Event, Rgb /*value*/, float /*weight*/) {}
  /// What comes to the film [pixels], as FilmTile::add_splat() wants it.
  void contribute(Vec2 /*film*/, Rgb /*contribution*/) {}
};

/// One path from a light, vertex by vertex, each of which is seen by the sensor:
///
///     emission -> see the light -> [ advance -> connect to the lens -> step ] until it ends
///
/// `Listener` hears of it (SilentLightListener). `Counterparts` know what else could have made the
/// path.
template <class Listener, class Counterparts = NoCounterparts>
class LightWalk {
 public:
  LightWalk(const LightScene& shared, const IterationContext& context, const SampleStream& stream,
            Arena& arena, RenderCounters& counters, Listener& listener,
            Counterparts counterparts = {})
      : shared_(shared),
        scene_(shared.target.scene),
        context_(context),
        stream_(stream),
        arena_(arena),
        counters_(counters),
        tracer_(scene_, counters),
        listener_(listener),
        counterparts_(std::move(counterparts)) {}

  void run() {
    ++counters_.paths;
    if (scene_.lights().empty()) return;
    ScatterStep step;
    bool goes = emit(step);
    while (goes && advance(step)) {
      scattering_.emplace(here().scattering(scene_, towards_previous_, Transport::importance));
      if (!scattering_->purely_discrete()) connect();
      if (bounce_ + 1 >= shared_.max_depth) break;
      ask_guide();
      goes = sample_step(*scattering_, guidance_, numbers(), step);
    }
  }

 private:
  const PathVertex& here() const { return vertices_[current_]; }
  VertexStream numbers() const {
    return {stream_, static_cast<std::uint16_t>(shared_.first_bounce + bounce_)};
  }

  // --- the light ------------------------------------------------------------------------------

  /// Draws a ray that leaves a light, and shows the light itself to the sensor. False when nothing
  /// can come of it.
  bool emit(ScatterStep& step) {
    const int index = shared_.lights.choose(0, numbers().get_1d(Purpose::light_choice));
    const Light& light = *scene_.lights()[static_cast<std::size_t>(index)];
    const float chosen = shared_.lights.probability(index);
    const EmissionSample emission = light.sample_emission(
        numbers().get_2d(Purpose::light_position), numbers().get_2d(Purpose::bsdf_direction));
    if (!(emission.pdf.direction > 0) || !(chosen > 0)) return false;
    start(emission);
    // What fills all of space has to be crossed from infinitely far away.
    if (emission.kind == VertexKind::environment && here().medium != nullptr) {
      before_scene_ =
          here().medium->transmittance({here().position(), -emission.direction}, kInfinity);
    }
    throughput_ = before_scene_ * emission.weight / chosen;
    listener_.arrive(here(), throughput_);
    if constexpr (Counterparts::kExist) counterparts_.begin(light, index, emission);
    if (emission.kind == VertexKind::environment) {
      show_environment(light, emission, chosen);
    } else if (emission.kind == VertexKind::surface) {
      show_surface(light, emission, chosen);
    }
    if (shared_.max_depth < 2 || is_black(throughput_)) return false;
    step.direction = emission.direction;
    step.event = Event::smooth_reflect;
    step.value = step.unguided_weight = Rgb(1);
    step.unguided_pdf = 1;
    return true;
  }

  void start(const EmissionSample& emission) {
    PathVertex& light = vertices_[current_];
    light.kind = emission.kind;
    light.surface = emission.point;
    light.medium =
        scene_.has_media() ? scene_.medium_at(light.origin_towards(emission.direction)) : nullptr;
  }

  /// An area light as it is seen from the lens.
  void show_surface(const Light& light, const EmissionSample& emission, float chosen) {
    const auto way = connection();
    if (!way) return;
    float cosine = dot(way->direction, emission.point.normal);
    if (!(cosine > 0)) return;
    if (planted(PlantedFault::camera_cosine_forgotten)) cosine = 1;
    const Rgb radiance = light.radiance(emission.point, way->direction);
    Passage passage;
    if (!look(*way, radiance, passage)) return;
    const Rgb transmittance = passage.transmittance;
    float weight = 1;
    if constexpr (Counterparts::kExist) {
      weight = counterparts_.of_light_seen(here(), way->lens, -way->direction, way->distance,
                                           way->direction_pdf(), transmittance);
    }
    contribute(way->film, weight * way->pdf * cosine / (emission.pdf.position * chosen) *
                              transmittance * radiance);
  }

  /// The environment as it is seen from the lens, if there is a film position that sees it there.
  void show_environment(const Light& light, const EmissionSample& emission, float chosen) {
    if (!light.is_environment()) return;
    const RenderTarget& target = shared_.target;
    const LensPoint lens = target.sensor.sample_lens(numbers().get_2d(Purpose::lens));
    const Vec3 towards = -emission.direction;
    const std::optional<SensorResponse> seen = target.sensor.response(lens, towards);
    if (!seen) return;
    Passage passage;
    const Ray ray{lens.position, towards, kInfinity};
    if (!tracer_.pass(ray, scene_.sensor_medium(), Rgb(1), passage)) return;
    const Rgb transmittance = passage.transmittance;
    float weight = 1;
    if constexpr (Counterparts::kExist) {
      weight = counterparts_.of_light_seen(here(), lens, towards, kInfinity, seen->direction_pdf,
                                           transmittance);
    }
    contribute(seen->film, weight * seen->direction_pdf / (emission.pdf.direction * chosen) *
                               transmittance * light.environment_radiance(towards));
  }

  // --- the lens -------------------------------------------------------------------------------

  std::optional<SensorConnection> connection() const {
    return shared_.target.sensor.connect(here().position(), numbers().get_2d(Purpose::lens));
  }

  void connect() {
    const auto way = connection();
    if (!way) return;
    const Rgb value = scattering_->evaluate(way->direction).value;
    if (is_black(value)) return;
    Passage passage;
    if (!look(*way, throughput_ * value, passage)) return;
    const Rgb transmittance = passage.transmittance;
    const Event event = scattering_->smooth_event(way->direction);
    float weight = 1;
    if constexpr (Counterparts::kExist) {
      weight = counterparts_.of_connection(here(), *way, event, transmittance);
    }
    const Rgb seen = way->pdf * transmittance * value;
    listener_.connection(way->lens, way->direction, event, seen, weight);
    contribute(way->film, weight * throughput_ * seen);
  }

  /// Fills in what is between here and the lens, for light of this strength; false when something
  /// hides it.
  bool look(const SensorConnection& way, Rgb strength, Passage& passage) const {
    const Ray ray =
        ray_between(here().origin_towards(way.direction), way.lens.position, way.direction);
    if (planted(PlantedFault::boundaries_cast_shadows) && scene_.occluded(ray)) return false;
    return tracer_.pass(ray, here().medium_towards(scene_, way.direction), strength, passage);
  }

  void contribute(Vec2 film, Rgb value) {
    const RenderTarget& target = shared_.target;
    const auto pixels = static_cast<float>(target.window.area());
    listener_.contribute(
        {film.x * static_cast<float>(target.width), film.y * static_cast<float>(target.height)},
        pixels * value);
  }

  // --- from vertex to vertex ------------------------------------------------------------------

  /// Traces a step to the next vertex and weights it. False when nothing can come of the path.
  bool advance(const ScatterStep& step) {
    const PathVertex& from = here();
    PathVertex& to = vertices_[1 - current_];
    const Ray ray{from.origin_towards(step.direction), step.direction};
    Segment segment;
    const bool arrives = tracer_.trace(ray, from.medium_towards(scene_, step.direction), step,
                                       throughput_ * step.value, numbers(), segment, to.surface);
    if (!arrives || !step.accepts(segment.kind, to.position())) return false;
    to.kind = segment.kind;
    to.medium = segment.medium;
    const Passage& passage = segment.passage;
    const Rgb weight = weight_of(step, segment, to);
    throughput_ *= weight;
    listener_.step(step, weight);
    if (is_black(throughput_) || to.kind == VertexKind::environment) return false;
    if constexpr (Counterparts::kExist) {
      counterparts_.advance(
          from, to, step, guidance_, segment.length,
          bounce_ == 0 ? before_scene_ * passage.transmittance : passage.transmittance);
    }
    towards_previous_ = -step.direction;
    current_ = 1 - current_;
    ++bounce_;
    listener_.arrive(here(), throughput_);
    return true;
  }

  /// f/p of a step.
  Rgb weight_of(const ScatterStep& step, const Segment& segment, const PathVertex& to) const {
    const Passage& passage = segment.passage;
    if (!guidance_.is_guided() && !scene_.has_media()) return step.unguided_weight;
    const StepDensity density = step_density(guidance_,
                                             {.direction = step.direction,
                                              .distance = segment.length,
                                              .position = to.position(),
                                              .kind = to.kind,
                                              .event = step.event,
                                              .medium_density = passage.medium_density},
                                             step.unguided_pdf);
    return density.total > 0 ? step.value * passage.transmittance / density.total : Rgb();
  }

  // --- scattering -----------------------------------------------------------------------------

  void ask_guide() {
    guidance_ = {};
    if (context_.guiding == nullptr) return;
    arena_.reset();
    const PathVertex& before = vertices_[1 - current_];
    previous_ = before.described(before.roughness(scene_));
    if (before.kind == VertexKind::environment) {
      previous_.position = scene_.environment_point(here().position(), towards_previous_);
    }
    // The query must live as long as its distribution: both until the next vertex is weighted.
    query_.emplace(GuidingQuery{.previous = &previous_,
                                .current = here().described(scattering_->roughness()),
                                .towards_previous = towards_previous_,
                                .transport = Transport::importance,
                                .bounce = 0,
                                .scattering = &*scattering_,
                                .medium = here().medium});
    guidance_ = context_.guiding->query(*query_, arena_);
  }

  const LightScene& shared_;
  const Scene& scene_;
  const IterationContext& context_;
  const SampleStream& stream_;
  Arena& arena_;
  RenderCounters& counters_;
  SegmentTracer tracer_;
  Listener& listener_;
  [[no_unique_address]] Counterparts counterparts_;

  Rgb before_scene_{1};       ///< transmittance from infinitely far away to where paths begin
  Rgb throughput_{1};         ///< power that the path stands for [W], then times f/p
  std::uint16_t bounce_ = 0;  ///< number of the current vertex; 0 on the light
  // Two vertices in turn: the scattering at one stays valid until the next has been weighted.
  std::array<PathVertex, 2> vertices_;
  int current_ = 0;
  Vec3 towards_previous_;
  std::optional<LocalScattering> scattering_;
  GuidingVertex previous_;
  std::optional<GuidingQuery> query_;
  Guidance guidance_;
};

}  // namespace pharos
