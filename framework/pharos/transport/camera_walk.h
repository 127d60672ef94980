#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <pharos/transport/kernel.h>
#include <pharos/transport/termination_choice.h>

namespace pharos {

/// Data that all paths from the sensor share in one render.
struct CameraScene {
  const RenderTarget& target;
  const PathSettings& settings;
  const LightSelector& lights;  ///< chooses lights for next event estimation
  /// Ends and splits paths in iterations that state no rule; null: paths neither end nor split.
  const TerminationRule* termination = nullptr;
};

/// One of the light samples at a vertex.
struct LightDraw {
  std::uint16_t branch = 0;  ///< as LightSelector::choose() takes it
  std::uint16_t copy = 0;    ///< lights are sampled several times where light samples split
  float weight = 1;          ///< 1 over the expected number of copies
};

/// The result of one path from the sensor.
struct PathSample {
  Rgb radiance;
  Vec2 film;  ///< [pixels]
  Features features;
  bool splat = false;  ///< the camera was guided, so the path may belong to any pixel
};

/// A path from the sensor in flight, with its result so far. Its counterparts know the paths from
/// lights that could have produced the same path. It is a value, like Path.
template <class Counterparts>
struct CameraPath {
  Path path;
  PathSample found;
  [[no_unique_address]] Counterparts counterparts;
};

/// Path tracing:
///
///     begin() -> [ emission -> light samples -> step ] until the path ends
///
/// Light that both light samples and steps can find is weighted by multiple importance sampling.
/// `Counterparts` know the densities of the paths from lights that produce the same path.
template <class Recorder, class Counterparts = NoCounterparts, class Rules = EstimatorRules>
class CameraWalk {
 public:
  using InFlight = CameraPath<Counterparts>;

  CameraWalk(const CameraScene& shared, const IterationContext& context, TransportArenas& arenas,
             RenderCounters& counters, Recorder& recorder)
      : shared_(shared),
        scene_(shared.target.scene),
        settings_(shared.settings),
        counters_(counters),
        arenas_(arenas),
        sampler_(context.sampler),
        termination_(context.termination != nullptr ? context.termination : shared.termination),
        kernel_(shared.target.scene, context.guiding, arenas, counters, recorder) {}

  /// Traces a path from its beginning to its end, with all of its branches. The path has at most
  /// `max_depth` segments.
  PathSample run(const SampleStream& stream, std::uint16_t max_depth,
                 Counterparts counterparts = {}) const {
    InFlight flight{Path(stream), {}, std::move(counterparts)};
    WaitingPaths* waiting = Counterparts::kExist ? nullptr : &arenas_.waiting;
    if (waiting != nullptr) waiting->begin(settings_.most_branches);
    bool goes = begin(flight);
    while (goes) goes = proceed(flight, max_depth, waiting);
    while (waiting != nullptr && waiting->take(flight.path)) {
      kernel_.settle(flight.path);
      for (goes = true; goes;) goes = proceed(flight, max_depth, waiting);
    }
    return flight.found;
  }

  /// Begins a path at the lens and traces it to its first vertex. Returns false if the path ends
  /// there.
  bool begin(InFlight& flight) const {
    ++counters_.paths;
    Path& path = flight.path;
    path.from_both_ends = Counterparts::kExist;
    const RenderTarget& target = shared_.target;
    const auto pixel = static_cast<int>(path.stream.key().index);
    const Vec2 in_pixel = target.jitter ? path.stream.get_2d({Purpose::pixel}) : Vec2{0.5f, 0.5f};
    const Vec2 size{static_cast<float>(target.width), static_cast<float>(target.height)};
    flight.found.film = {static_cast<float>(pixel % target.width) + in_pixel.x,
                         static_cast<float>(pixel / target.width) + in_pixel.y};
    LensPoint lens = target.sensor.sample_lens(path.stream.get_2d({Purpose::lens}));
    const Ray ray =
        target.sensor.ray(lens, {flight.found.film.x / size.x, flight.found.film.y / size.y});
    lens.position = ray.origin;
    place(lens, path);
    kernel_.recorder().begin(path, flight.found.film);
    kernel_.begin(path);

    ScatterStep step;
    step.direction = ray.direction;
    step.event = Event::smooth_reflect;
    step.value = step.unguided_weight = Rgb(1);
    step.unguided_pdf = 1;
    GuidingQuery query;  // must live as long as the guidance
    Guidance guidance;
    const GuidingFrame* guiding = kernel_.guiding();
    if (guiding != nullptr && guiding->guides_camera()) {
      flight.found.splat = true;
      guidance = kernel_.guidance_at_lens(path, query);
      if (!guide_first_step(flight, lens, size, guidance, step)) return false;
    }
    flight.found.features.cost = 1;
    const bool goes = kernel_.advance(path, step, guidance, flight.counterparts);
    if (flight.found.splat) path.film_weight = path.arrival.unguided / path.arrival.total;
    if (path.bounce == 1) note_features(flight);
    return goes;
  }

  /// Collects light at the current vertex and traces the path to the next vertex. If the path
  /// splits, the other branches wait in `waiting`; if this is null, the path does not split.
  /// Returns false if the path ends.
  bool proceed(InFlight& flight, std::uint16_t max_depth, WaitingPaths* waiting = nullptr) const {
    add_emission(flight);
    if (!goes_on(flight.path, max_depth)) return false;
    Visitor visitor{*this, flight, waiting};
    return kernel_.extend(flight.path, visitor, flight.counterparts);
  }

  /// Begins a path, traces it to the vertex number `bounce`, and calls
  /// `visit(scattering, guidance)` there if lights are sampled at this vertex.
  template <class Visit>
  void visit_vertex(InFlight& flight, std::uint16_t bounce, Visit&& visit) const {
    bool goes = begin(flight);
    while (goes && goes_on(flight.path, settings_.max_depth)) {
      VertexVisitor<Visit> visitor{*this, flight, bounce, visit};
      goes = kernel_.extend(flight.path, visitor, flight.counterparts);
    }
  }

  /// Takes a light sample at the current vertex. `numbers` choose the light, and `u` in [0,1)^2 the
  /// position on it.
  void sample_light(InFlight& flight, const LocalScattering& scattering, const Guidance& guidance,
                    LightDraw draw, const VertexStream& numbers, Vec2 u) const {
    const Path& path = flight.path;
    const float u_choice =
        shared_.lights.needs_number() ? numbers.get_1d(Purpose::light_choice, draw.branch) : 0;
    const int index = shared_.lights.choose(draw.branch, u_choice);
    const Light& emitter = *scene_.lights()[static_cast<std::size_t>(index)];
    LightSample light = emitter.sample(path.here().position(), u);
    light.pdf = Rules::light_sample_pdf(light.pdf, shared_.lights.probability(index));
    if (light.kind == VertexKind::environment) {
      light.point.position = scene_.environment_point(path.here().position(), light.direction);
    }
    if (!(light.pdf > 0) || is_black(light.radiance)) return;
    add_light_sample(flight, scattering, guidance, emitter, index, light, draw);
  }

 private:
  /// The visitor of ordinary paths: samples lights at each vertex, and ends or splits paths.
  struct Visitor {
    const CameraWalk& walk;
    InFlight& flight;
    WaitingPaths* waiting;
    Branching branching = {};  ///< at the current vertex

    bool meets(Path&, const LocalScattering&) const { return true; }
    void leaves(Path& path, const LocalScattering& scattering, const Guidance& guidance) const {
      if (!walk.samples_lights(scattering)) return;
      const std::uint16_t branches = walk.shared_.lights.branches();
      walk.kernel_.recorder().lights(path, branching.lights, branches);
      LightDraw draw{.weight = branching.light_weight};
      for (; draw.copy < branching.lights; ++draw.copy) {
        const VertexStream numbers = Rules::copy_numbers(path.numbers(), draw.copy);
        for (draw.branch = 0; draw.branch < branches; ++draw.branch) {
          walk.sample_light(flight, scattering, guidance, draw, numbers,
                            numbers.get_2d(Purpose::light_position, draw.branch));
        }
      }
    }
    bool survives(Path& path, const LocalScattering& scattering, ScatterStep& step) const {
      const bool goes = walk.termination_.survives(path, flight.found.film, scattering, step);
      flight.found.features.cost += goes ? 1 : 0;
      return goes;
    }
    Branching branches(const Path& path, const LocalScattering& scattering) {
      const std::uint32_t most_new = waiting != nullptr ? waiting->left() : 0;
      branching = walk.termination_.branching(path, flight.found.film, scattering, most_new,
                                              kMostLightCopies);
      Features& features = flight.found.features;
      if (path.bounce <= features.splitting.size()) {
        features.splitting[path.bounce - 1].add(1 / branching.weight);
      }
      if (!branching.is_plain()) features.cost += static_cast<float>(branching.count);
      return branching;
    }
    Path& add_branch(const Path& trunk) const {
      Path& branch = waiting->add(trunk);
      PathKey key = trunk.stream.key();
      key.seed = Rules::branch_seed(key.seed, branch.branch);
      branch.stream = SampleStream(walk.sampler_, key);
      return branch;
    }
    void drop_branch() const { waiting->drop(); }
  };

  /// The visitor of visit_vertex(): ends the path at the vertex number `bounce`.
  template <class Visit>
  struct VertexVisitor {
    const CameraWalk& walk;
    InFlight& flight;
    std::uint16_t bounce;
    Visit& visit;
    bool is_there = false;

    bool meets(Path& path, const LocalScattering&) {
      is_there = path.bounce == bounce;
      return true;
    }
    void leaves(Path&, const LocalScattering& scattering, const Guidance& guidance) const {
      if (is_there && walk.samples_lights(scattering)) visit(scattering, guidance);
    }
    bool survives(Path& path, const LocalScattering& scattering, ScatterStep& step) const {
      return !is_there && walk.termination_.survives(path, flight.found.film, scattering, step);
    }
  };

  /// Returns whether the path may have a segment beyond the current vertex.
  static bool goes_on(const Path& path, std::uint16_t max_depth) {
    return path.here().kind != VertexKind::environment && path.bounce < max_depth;
  }
  bool samples_lights(const LocalScattering& scattering) const {
    return settings_.next_event_estimation && !scattering.purely_discrete();
  }

  // --- the first vertex ----------------------------------------------------------------------

  void place(const LensPoint& lens, Path& path) const {
    PathVertex& start = path.vertices[path.at];
    start.surface.position = lens.position;
    start.surface.normal = lens.normal;
    start.surface.shading.n = lens.normal;
    start.medium = scene_.sensor_medium();
    path.towards_previous = lens.normal;
  }

  /// Draws the first step of a path if the camera is guided, from a mixture of uniform film
  /// positions and directions of the guides. A path of any pixel may land in any other pixel, so
  /// all contributions become splats. Returns false if the path has value zero.
  bool guide_first_step(InFlight& flight, const LensPoint& lens, Vec2 size,
                        const Guidance& guidance, ScatterStep& step) const {
    const VertexStream stream = flight.path.numbers();
    const float u = guidance.is_guided() ? stream.get_1d(Purpose::mix_choice) : 0;
    if (guidance.guides(u)) {
      const std::optional<Proposal> proposal = guidance.propose(stream, guidance.rest_of(u));
      if (!proposal) return false;
      step.direction = proposal->direction;
      step.reach = proposal->reach;
      step.distance = proposal->distance;
      step.targets = proposal->targets;
      step.within = proposal->within;
    }
    const auto response = shared_.target.sensor.response(lens, step.direction);
    if (!response) return false;
    flight.found.film = {response->film.x * size.x, response->film.y * size.y};
    kernel_.recorder().film(flight.found.film);
    step.unguided_pdf = response->direction_pdf;
    step.value = Rgb(response->direction_pdf);
    return true;
  }

  /// Stores the features of the first vertex.
  void note_features(InFlight& flight) const {
    const PathVertex& here = flight.path.here();
    if (here.kind != VertexKind::surface) return;
    Features& features = flight.found.features;
    features.albedo = scene_.bsdf(here.surface).albedo(here.surface);
    features.normal = here.surface.shading.n;
    features.depth = flight.path.segment_length;
    kernel_.recorder().features(features.albedo, features.normal);
  }

  // --- light ----------------------------------------------------------------------------------

  void add_emission(InFlight& flight) const {
    const Path& path = flight.path;
    const PathVertex& here = path.here();
    if (here.kind == VertexKind::surface) {
      const Light* light = scene_.light_at(here.surface);
      if (light == nullptr) return;
      const Rgb radiance = light->radiance(here.surface, path.towards_previous);
      if (is_black(radiance)) return;
      add_light(flight, *light, scene_.light_index(here.surface), radiance, [&] {
        const Point3 origin =
            Rules::light_sample_origin(scene_, path.before().position(), here.surface);
        return light->pdf_point(origin, here.surface);
      });
    } else if (here.kind == VertexKind::environment) {
      for (const int index : scene_.environment_lights()) {
        const Light& light = *scene_.lights()[static_cast<std::size_t>(index)];
        add_light(flight, light, index, light.environment_radiance(-path.towards_previous),
                  [&] { return light.pdf_direction(-path.towards_previous); });
      }
    }
  }

  /// Adds emission that the path has hit. `light_pdf()` returns the density of a light sample at
  /// this point, without the probability of choosing the light.
  template <class LightPdf>
  void add_light(InFlight& flight, const Light& light, int index, Rgb radiance,
                 LightPdf&& light_pdf) const {
    const Path& path = flight.path;
    const bool alone = path.arrived_discretely || !settings_.next_event_estimation;
    const float sampled = alone ? 0.0f : shared_.lights.probability(index) * light_pdf();
    const float weight = alone ? 1.0f : Rules::emission_weight(settings_.mis, path, sampled);
    float whole_weight = weight;
    if constexpr (Counterparts::kExist) {
      if (is_black(radiance)) return;
      whole_weight = flight.counterparts.of_emission(light, index, path.here(), sampled);
    }
    flight.found.radiance += whole_weight * path.throughput * radiance;
    float unguided_weight = weight;
    if constexpr (Recorder::kRecords) {
      if (!alone) unguided_weight = emission_weight(settings_.mis, path.arrival.unguided, sampled);
    }
    kernel_.recorder().emission(path, radiance, {weight, whole_weight, unguided_weight});
  }

  void add_light_sample(InFlight& flight, const LocalScattering& scattering,
                        const Guidance& guidance, const Light& emitter, int index,
                        const LightSample& light, LightDraw draw) const {
    const Path& path = flight.path;
    const PathVertex& here = path.here();
    const ScatterValue scatter = scattering.evaluate(light.direction);
    Rgb value = draw.weight * scatter.value * light.radiance / light.pdf;
    if (is_black(value)) return;
    Ray shadow{here.origin_towards(light.direction), light.direction, light.distance};
    // The ray ends just before the light's surface, by the uncertainty of positions there.
    if (std::isfinite(light.distance)) {
      shadow =
          ray_between(shadow.origin, light.point.origin_towards(-light.direction), light.direction);
    }
    Passage passage;
    if (!kernel_.tracer().pass(shadow, here.medium_towards(scene_, light.direction),
                               path.throughput * scatter.value, passage)) {
      return;
    }
    value *= passage.transmittance;
    const ResolvedVertex resolved{.direction = light.direction,
                                  .distance = light.distance,
                                  .position = light.point.position,
                                  .kind = light.kind,
                                  .event = scattering.smooth_event(light.direction),
                                  .medium_density = passage.medium_density};
    // No step can hit a light without extent.
    float weight = 1, unguided_weight = 1;
    if (!light.discrete) {
      const StepDensity step = step_density(guidance, resolved, scatter.pdf);
      weight = Rules::light_sample_weight(settings_.mis, light.pdf, step, passage.medium_density);
      if constexpr (Recorder::kRecords) {
        unguided_weight = light_sample_weight(settings_.mis, light.pdf, step.unguided);
      }
    }
    float whole_weight = weight;
    if constexpr (Counterparts::kExist) {
      whole_weight =
          flight.counterparts.of_light_sample(emitter, index, light, scatter.pdf, guidance, here,
                                              resolved.event, passage.transmittance);
    }
    flight.found.radiance += whole_weight * path.throughput * value;
    kernel_.recorder().connect(path,
                               {.position = light.point.position,
                                .kind = light.kind,
                                .direction = light.direction,
                                .event = resolved.event,
                                .discrete = light.discrete,
                                .copy = draw.copy,
                                .continuation = draw.weight},
                               {weight, whole_weight, unguided_weight}, value);
  }

  const CameraScene& shared_;
  const Scene& scene_;
  const PathSettings& settings_;
  RenderCounters& counters_;
  TransportArenas& arenas_;
  const PreparedSampler& sampler_;
  TerminationChoice<Rules> termination_;
  TransportKernel<Recorder, Rules> kernel_;
};

}  // namespace pharos
