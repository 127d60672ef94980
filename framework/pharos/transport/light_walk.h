#pragma once

#include <optional>
#include <utility>

#include <pharos/transport/kernel.h>
#include <pharos/transport/termination_choice.h>

namespace pharos {

/// Data that all paths from lights share in one render.
struct LightScene {
  const RenderTarget& target;
  const LightSelector& lights;  ///< chooses the light of a path in proportion to power
  std::uint16_t max_depth;      ///< largest number of segments, including the one to the lens
  /// Number of the vertex on the light in the dimensions of the stream.
  std::uint16_t first_bounce = 0;
  /// Ends paths by Russian roulette; null: paths end at `max_depth` only. Paths from lights do not
  /// split. MIS weights ignore roulette: they sum to one for each path, whatever the probability
  /// that it survives.
  const TerminationRule* termination = nullptr;
};

/// A path from a light in flight. Its counterparts know the paths from the lens that could have
/// produced the same path. It is a value, like Path.
template <class Counterparts>
struct LightPath {
  Path path;
  [[no_unique_address]] Counterparts counterparts;
};

/// Light tracing:
///
///     begin() -> [ connect to the lens -> step ] until the path ends
///
/// Every vertex is connected to the lens, including the vertex on the light. `Counterparts` know
/// the densities of the paths from the lens that produce the same path.
template <class Recorder, class Counterparts = NoCounterparts, class Rules = EstimatorRules>
class LightWalk {
 public:
  using InFlight = LightPath<Counterparts>;

  LightWalk(const LightScene& shared, const IterationContext& context, TransportArenas& arenas,
            RenderCounters& counters, Recorder& recorder)
      : shared_(shared),
        scene_(shared.target.scene),
        counters_(counters),
        termination_(shared.termination),
        kernel_(shared.target.scene, context.guiding, arenas, counters, recorder) {}

  /// Traces a path from its beginning to its end.
  void run(const SampleStream& stream, Counterparts counterparts = {}) const {
    InFlight flight{Path(stream), std::move(counterparts)};
    bool goes = begin(flight);
    while (goes) goes = proceed(flight);
  }

  /// Begins a path at a light, connects the light itself to the lens, and traces the path to its
  /// first vertex beyond the light. Returns false if the path ends before.
  bool begin(InFlight& flight) const {
    ++counters_.paths;
    Path& path = flight.path;
    path.transport = Transport::importance;
    path.from_both_ends = true;
    path.first_bounce = shared_.first_bounce;
    kernel_.recorder().begin(path, {});
    ScatterStep step;
    return !scene_.lights().empty() && emit(flight, step) &&
           kernel_.advance(path, step, {}, flight.counterparts);
  }

  /// Connects the current vertex to the lens and traces the path to the next vertex. Returns false
  /// if the path ends.
  bool proceed(InFlight& flight) const {
    Visitor visitor{*this, flight.counterparts};
    return kernel_.extend(flight.path, visitor, flight.counterparts);
  }

 private:
  struct Visitor {
    const LightWalk& walk;
    Counterparts& counterparts;

    bool meets(Path& path, const LocalScattering& scattering) const {
      walk.place_environment(path);
      if (!scattering.purely_discrete()) walk.connect(path, scattering, counterparts);
      return path.bounce + 1 < walk.shared_.max_depth;
    }
    void leaves(Path&, const LocalScattering&, const Guidance&) const {}
    Branching branches(const Path& path, const LocalScattering& scattering) const {
      return walk.termination_.branching(path, {}, scattering, 0, 1);
    }
    bool survives(Path& path, const LocalScattering& scattering, ScatterStep& step) const {
      return walk.termination_.survives(path, {}, scattering, step);
    }
  };

  // --- the light ------------------------------------------------------------------------------

  /// Draws a ray that leaves a light, and connects the light itself to the lens. Returns false if
  /// the path cannot contribute any more.
  bool emit(InFlight& flight, ScatterStep& step) const {
    Path& path = flight.path;
    const VertexStream numbers = path.numbers();
    const int index = shared_.lights.choose(0, numbers.get_1d(Purpose::light_choice));
    const Light& light = *scene_.lights()[static_cast<std::size_t>(index)];
    const float chosen = shared_.lights.probability(index);
    const EmissionSample emission = light.sample_emission(numbers.get_2d(Purpose::light_position),
                                                          numbers.get_2d(Purpose::bsdf_direction));
    if (!(emission.pdf.direction > 0) || !(chosen > 0)) return false;
    place(emission, path);
    // Light from the environment crosses media from infinity.
    Rgb before_scene(1);
    if (emission.kind == VertexKind::environment && path.here().medium != nullptr) {
      const Ray ray{path.here().position(), -emission.direction};
      before_scene = path.here().medium->leg(ray, channel_shares(Rgb(1)), kInfinity).transmittance;
    }
    path.throughput = before_scene * emission.weight / chosen;
    kernel_.begin(path);
    if constexpr (Counterparts::kExist) {
      flight.counterparts.begin(light, index, emission, before_scene);
    }
    if (emission.kind == VertexKind::environment) {
      show_environment(flight, light, emission, chosen);
    } else if (emission.kind == VertexKind::surface) {
      show_surface(flight, light, emission, chosen);
    }
    if (shared_.max_depth < 2 || is_black(path.throughput)) return false;
    step.direction = emission.direction;
    step.event = Event::smooth_reflect;
    step.value = step.unguided_weight = Rgb(1);
    step.unguided_pdf = 1;
    return true;
  }

  void place(const EmissionSample& emission, Path& path) const {
    PathVertex& start = path.vertices[path.at];
    start.kind = emission.kind;
    start.surface = emission.point;
    start.medium =
        scene_.has_media() ? scene_.medium_at(start.origin_towards(emission.direction)) : nullptr;
  }

  /// Moves the environment vertex for guides to the point that the first vertex sees.
  void place_environment(Path& path) const {
    if (path.bounce != 1 || path.previous.kind != VertexKind::environment) return;
    path.previous.position =
        scene_.environment_point(path.here().position(), path.towards_previous);
  }

  /// Adds the contribution of an area light that the lens sees directly.
  void show_surface(const InFlight& flight, const Light& light, const EmissionSample& emission,
                    float chosen) const {
    const Path& path = flight.path;
    const auto way = connection(path);
    if (!way) return;
    const float cosine = dot(way->direction, emission.point.normal);
    if (!(cosine > 0)) return;
    const Rgb radiance = light.radiance(emission.point, way->direction);
    Passage passage;
    if (!look(path, *way, radiance, passage)) return;
    const Rgb transmittance = passage.transmittance;
    float weight = 1;
    if constexpr (Counterparts::kExist) {
      weight = flight.counterparts.of_light_seen(path.here(), way->lens, -way->direction,
                                                 way->distance, way->response(), transmittance);
    }
    contribute(way->film, weight * way->pdf * Rules::foreshortening(cosine) /
                              (emission.pdf.position * chosen) * transmittance * radiance);
  }

  /// Adds the contribution of the environment that the lens sees directly, if any film position
  /// sees it in this direction.
  void show_environment(const InFlight& flight, const Light& light, const EmissionSample& emission,
                        float chosen) const {
    if (!light.is_environment()) return;
    const RenderTarget& target = shared_.target;
    const LensPoint lens = target.sensor.sample_lens(flight.path.numbers().get_2d(Purpose::lens));
    const Vec3 towards = -emission.direction;
    const std::optional<SensorResponse> seen = target.sensor.response(lens, towards);
    if (!seen) return;
    Passage passage;
    const Ray ray{lens.position, towards, kInfinity};
    if (!kernel_.tracer().pass(ray, scene_.sensor_medium(), Rgb(1), passage)) return;
    const Rgb transmittance = passage.transmittance;
    float weight = 1;
    if constexpr (Counterparts::kExist) {
      weight = flight.counterparts.of_light_seen(flight.path.here(), lens, towards, kInfinity,
                                                 *seen, transmittance);
    }
    contribute(seen->film, weight * seen->direction_pdf / (emission.pdf.direction * chosen) *
                               transmittance * light.environment_radiance(towards));
  }

  // --- the lens -------------------------------------------------------------------------------

  std::optional<SensorConnection> connection(const Path& path) const {
    return shared_.target.sensor.connect(path.here().position(),
                                         path.numbers().get_2d(Purpose::lens));
  }

  void connect(const Path& path, const LocalScattering& scattering,
               const Counterparts& counterparts) const {
    const auto way = connection(path);
    if (!way) return;
    const Rgb value = scattering.evaluate(way->direction).value;
    if (is_black(value)) return;
    Passage passage;
    if (!look(path, *way, path.throughput * value, passage)) return;
    const Rgb transmittance = passage.transmittance;
    const Event event = scattering.smooth_event(way->direction);
    float weight = 1;
    if constexpr (Counterparts::kExist) {
      weight = counterparts.of_connection(path.here(), *way, event, transmittance);
    }
    const Rgb seen = way->pdf * transmittance * value;
    kernel_.recorder().connect(path,
                               {.position = way->lens.position,
                                .kind = VertexKind::sensor,
                                .direction = way->direction,
                                .event = event},
                               {1, weight}, seen);
    contribute(way->film, weight * path.throughput * seen);
  }

  /// Fills in the passage from the current vertex to the lens, for light of this strength. Returns
  /// false if the lens is occluded.
  bool look(const Path& path, const SensorConnection& way, Rgb strength, Passage& passage) const {
    const PathVertex& here = path.here();
    const Ray ray =
        ray_between(here.origin_towards(way.direction), way.lens.position, way.direction);
    return kernel_.tracer().pass(ray, here.medium_towards(scene_, way.direction), strength,
                                 passage);
  }

  void contribute(Vec2 film, Rgb value) const {
    const RenderTarget& target = shared_.target;
    const auto pixels = static_cast<float>(target.window.area());
    kernel_.recorder().contribute(
        {film.x * static_cast<float>(target.width), film.y * static_cast<float>(target.height)},
        pixels * value);
  }

  const LightScene& shared_;
  const Scene& scene_;
  RenderCounters& counters_;
  TerminationChoice<Rules> termination_;
  TransportKernel<Recorder, Rules> kernel_;
};

}  // namespace pharos
