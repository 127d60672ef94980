#pragma once

#include <algorithm>
#include <optional>

#include <pharos/core/arena.h>
#include <pharos/rendering/integrator.h>
#include <pharos/transport/estimator_rules.h>
#include <pharos/transport/recorder.h>
#include <pharos/transport/waiting_paths.h>

namespace pharos {

/// Memory for guides and branches during one work unit.
struct TransportArenas {
  Arena vertex;  ///< objects that live until the next vertex is known
  Arena path;    ///< objects that guides remember along paths; reset when no path is in flight
  WaitingPaths waiting;  ///< branches of the path in flight
};

/// The counterparts of a walk whose paths cannot be produced from the other end. Such a walk needs
/// no MIS weights for both ends.
struct NoCounterparts {
  static constexpr bool kExist = false;
};

/// Advances paths from vertex to vertex, both from the sensor and from lights:
///
///     begin(path) -> advance(path, first step) -> extend(path, …) until it returns false
///
/// A step is traced before it is weighted, because the density of a guided step may depend on what
/// it hits. The whole state of a path is in the Path, so that calls for different paths may
/// alternate. `Recorder` receives a report of every event (recorder.h).
template <class Recorder, class Rules = EstimatorRules>
class TransportKernel {
 public:
  TransportKernel(const Scene& scene, const GuidingFrame* guiding, TransportArenas& arenas,
                  RenderCounters& counters, Recorder& recorder)
      : scene_(scene),
        guiding_(guiding),
        arenas_(arenas),
        counters_(counters),
        tracer_(scene, counters),
        recorder_(recorder) {}

  const Scene& scene() const { return scene_; }
  const GuidingFrame* guiding() const { return guiding_; }
  Recorder& recorder() const { return recorder_; }
  const typename Rules::Tracer& tracer() const { return tracer_; }

  /// Begins a path at `path.here()`, its first vertex.
  void begin(Path& path) const { describe_arrival(path); }

  /// Returns the guidance at the first vertex, on the lens. The guidance lives until the path is
  /// advanced.
  Guidance guidance_at_lens(Path& path, GuidingQuery& query) const {
    query = {.current = path.current, .towards_previous = path.towards_previous, .bounce = 0};
    return ask(path, query);
  }

  /// Continues a path from its current vertex to the next one. `visitor` does what is specific to
  /// the kind of path:
  ///
  ///     // Called before guides are asked. Returns false if the path ends here.
  ///     bool meets(Path&, const LocalScattering&)
  ///     // Called before the path leaves the vertex, for example to sample lights.
  ///     void leaves(Path&, const LocalScattering&, const Guidance&)
  ///     // Plays Russian roulette: sets `continuation` of the step, 0 if the path ends. Returns
  ///     // false if the path ends here.
  ///     bool survives(Path&, const LocalScattering&, ScatterStep&)
  ///
  /// A visitor may decide before a step is drawn, too:
  ///
  ///     // Returns how many steps are taken; 0: the path ends here. It is called before leaves(),
  ///     // so it can also decide how often lights are sampled.
  ///     Branching branches(const Path&, const LocalScattering&)
  ///
  /// If there may be more than one step, it has two more functions:
  ///
  ///     // Returns a copy of the path, with other random numbers from its next vertex on. The
  ///     // kernel takes it there, where it waits for settle().
  ///     Path& add_branch(const Path&)
  ///     // Called if the branch that was added last has ended.
  ///     void drop_branch()
  ///
  /// Returns false if the path ends; its throughput no longer matters then.
  template <class Visitor, class Counterparts>
  bool extend(Path& path, Visitor& visitor, Counterparts& counterparts) const {
    const LocalScattering scattering =
        path.here().scattering(scene_, path.towards_previous, path.transport);
    if (!visitor.meets(path, scattering)) return false;
    ++counters_.vertices;
    std::optional<GuidingQuery> query;  // must live as long as the guidance
    const Guidance guidance =
        guiding_ != nullptr ? guidance_at_vertex(path, scattering, query.emplace()) : Guidance{};
    recorder_.leave(path, scattering, guidance);
    Branching branching;
    if constexpr (requires { visitor.branches(path, scattering); }) {
      branching = visitor.branches(path, scattering);
    }
    visitor.leaves(path, scattering, guidance);
    if (!branching.is_plain()) {
      return split(path, scattering, guidance, branching, visitor, counterparts);
    }
    ScatterStep step;
    if (!sample_step(scattering, guidance, path.numbers(), step)) return false;
    const bool survives = visitor.survives(path, scattering, step);
    if (step.continuation != 1) recorder_.weigh(path, step.continuation);
    return survives && advance(path, step, guidance, counterparts);
  }

  /// Continues a branch that has waited at its current vertex.
  void settle(Path& branch) const { describe_arrival(branch); }

  /// Traces a step to the next vertex and weights it. Returns false if the path cannot contribute
  /// any more.
  template <class Counterparts>
  bool advance(Path& path, const ScatterStep& step, const Guidance& guidance,
               Counterparts& counterparts) const {
    if (!travel(path, step, guidance, path.numbers(), counterparts)) return false;
    describe_arrival(path);
    return !is_black(path.throughput);
  }

 private:
  /// Takes `branching.count` steps from the current vertex of a path. All of them share the
  /// guidance, and their random numbers are evenly spread together. The path itself takes the last
  /// step, because the others need its state. Paths with counterparts take one step at most.
  template <class Visitor, class Counterparts>
  bool split(Path& path, const LocalScattering& scattering, const Guidance& guidance,
             Branching branching, Visitor& visitor, Counterparts& counterparts) const {
    recorder_.weigh(path, branching.count > 0 ? branching.weight : 0);
    path.branches *= std::max(1 / branching.weight, 1.0f);
    if constexpr (requires { visitor.add_branch(path); }) {
      NoCounterparts none;
      for (std::uint32_t i = 1; i < branching.count; ++i) {
        Path& branch = visitor.add_branch(path);
        recorder_.split(path, branch);
        ScatterStep step;
        const VertexStream numbers = Rules::copy_numbers(path.numbers(), i);
        const bool goes = draw(numbers, scattering, guidance, branching.weight, step) &&
                          travel(branch, step, guidance, numbers, none) &&
                          !is_black(branch.throughput);
        if (!goes) visitor.drop_branch();
      }
    }
    ScatterStep step;
    return branching.count > 0 &&
           draw(path.numbers(), scattering, guidance, branching.weight, step) &&
           advance(path, step, guidance, counterparts);
  }

  /// Draws a step that stands for `weight` of the steps from the vertex. Returns false for a valid
  /// sample of value zero.
  static bool draw(const VertexStream& numbers, const LocalScattering& scattering,
                   const Guidance& guidance, float weight, ScatterStep& step) {
    if (!sample_step(scattering, guidance, numbers, step)) return false;
    step.continuation = weight;
    return true;
  }

  /// Takes a path to its next vertex, as advance() does, but does not describe the vertex. Returns
  /// false if the step ends nowhere.
  template <class Counterparts>
  bool travel(Path& path, const ScatterStep& step, const Guidance& guidance,
              const VertexStream& numbers, Counterparts& counterparts) const {
    const PathVertex& from = path.here();
    PathVertex& to = path.vertices[1 - path.at];
    const Ray ray{from.origin_towards(step.direction), step.direction};
    Segment segment;
    const bool arrives = tracer_.trace(ray, from.medium_towards(scene_, step.direction), step,
                                       path.throughput * step.value, numbers, segment, to.surface);
    if (!arrives || !step.accepts(segment.kind, to.position())) return false;
    to.kind = segment.kind;
    to.medium = segment.medium;
    weight_step(path, step, guidance, segment, to);
    const bool is_lost = path.transport == Transport::importance &&
                         (is_black(path.throughput) || to.kind == VertexKind::environment);
    if (is_lost) return false;
    if constexpr (Counterparts::kExist) {
      counterparts.advance(from, to, step, guidance, segment.length, segment.passage.transmittance);
    }
    move_on(path, step, segment.length);
    return true;
  }

  /// Returns whether a guide or a recorder needs descriptions of vertices.
  bool describes_vertices() const { return Recorder::kRecords || guiding_ != nullptr; }

  /// Fills in the description of the current vertex, at which the path has just arrived.
  void describe_arrival(Path& path) const {
    if (!describes_vertices()) return;
    path.here().describe(path.here().roughness(scene_), path.current);
    recorder_.arrive(path);
  }

  /// Returns the guidance at a vertex after the first one. Fills in `query` in place, as steps are
  /// (scatter_step.h).
  Guidance guidance_at_vertex(Path& path, const LocalScattering& scattering,
                              GuidingQuery& query) const {
    query.previous = &path.previous;
    query.current = path.current;
    query.towards_previous = path.towards_previous;
    query.transport = path.transport;
    query.bounce = path.from_both_ends ? std::uint16_t{0} : path.bounce;
    query.scattering = &scattering;
    query.medium = path.here().medium;
    return ask(path, query);
  }

  Guidance ask(Path& path, GuidingQuery& query) const {
    arenas_.vertex.reset();
    // The memory of a guide would depend on the end at which the path began.
    PathMemories* memories = path.from_both_ends ? nullptr : &path.memories;
    return guiding_->query(query, arenas_.vertex, memories, &arenas_.path);
  }

  /// Multiplies the throughput by f/p of a step that led to `to`.
  void weight_step(Path& path, const ScatterStep& step, const Guidance& guidance,
                   const Segment& segment, const PathVertex& to) const {
    const ResolvedVertex resolved{.direction = step.direction,
                                  .distance = segment.length,
                                  .position = to.position(),
                                  .kind = to.kind,
                                  .event = step.event,
                                  .medium_density = segment.passage.medium_density};
    const Rgb transmittance = segment.passage.transmittance;
    set_step_density(guidance, resolved, step.unguided_pdf, path.arrival);
    path.arrival.total = Rules::drawn_density(path.arrival, guidance.unguided_share);
    path.medium_density = resolved.medium_density;
    const bool plain = !guidance.is_guided() && !scene_.has_media();
    Rgb weight = plain                    ? step.unguided_weight
                 : path.arrival.total > 0 ? step.value * transmittance / path.arrival.total
                                          : Rgb();
    weight *= step.continuation * Rules::resampling_weight(step.resampling);
    path.arrived_discretely = path.bounce == 0 || is_discrete(step.event);
    path.throughput *= weight;
    recorder_.step(path, step, guidance, weight, resolved, transmittance);
  }

  /// Makes the vertex at the end of a step the current vertex.
  void move_on(Path& path, const ScatterStep& step, float length) const {
    if (describes_vertices()) {
      path.previous = path.current;
      if (!path.from_both_ends) path.previous.event = step.event;
    }
    path.towards_previous = -step.direction;
    path.segment_length = length;
    path.at = 1 - path.at;
    if (++path.bounce == 1) path.first_throughput = max_component(path.throughput);
  }

  const Scene& scene_;
  const GuidingFrame* guiding_;
  TransportArenas& arenas_;
  RenderCounters& counters_;
  typename Rules::Tracer tracer_;
  Recorder& recorder_;
};

}  // namespace pharos
