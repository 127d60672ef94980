#pragma once

#include <array>
#include <utility>

#include <pharos/guiding/record/path_record.h>
#include <pharos/transport/scatter_step.h>

namespace pharos {

/// MIS weights of one way to make a path.
struct PathWeight {
  float own_end = 1;    ///< among the techniques of paths from the same end
  float both_ends = 1;  ///< among the techniques of all paths
};

/// The end of a connection from a vertex: a light sample, or the lens.
struct Connection {
  Point3 position;
  VertexKind kind = VertexKind::surface;
  Vec3 direction;             ///< unit, from the vertex
  Event event = Event::none;  ///< of scattering into `direction` at the vertex
  bool discrete = false;      ///< no step can hit the end: it is a light without extent
};

/// What the transport kernel and the walks report, call by call along a path. This recorder ignores
/// everything and compiles to nothing; others hide the functions of the calls that they use.
struct SilentRecorder {
  /// Whether vertices must be described in full.
  static constexpr bool kRecords = false;

  /// A path begins; `film` in pixels, unknown for paths from lights.
  void begin(Transport, Vec2 /*film*/) {}
  /// A guide of the camera chose this place on the film [pixels].
  void film(Vec2) {}
  /// A vertex is reached, the first one included.
  void arrive(const GuidingVertex&, Rgb /*throughput*/, std::uint32_t /*branch*/) {}
  /// Emission of the current vertex.
  void emission(Rgb /*radiance*/, PathWeight) {}
  /// The path is about to leave the current vertex.
  void leave(const LocalScattering&, float /*roughness*/, const Guidance&) {}
  /// A connection from the current vertex; `value` is its f/p, without throughput.
  void connect(const Connection&, PathWeight, Rgb /*value*/, Rgb /*throughput*/) {}
  /// The step from the current vertex, once the next vertex is known.
  void step(const ScatterStep&, const StepDensity&, const Guidance&, Rgb /*weight*/,
            const ResolvedVertex&, Rgb /*transmittance*/) {}
  /// What a path from a light adds to the film [pixels], as FilmTile::add_splat() takes it.
  void contribute(Vec2 /*film*/, Rgb /*contribution*/) {}
};

/// Writes paths into a PathLog.
class LogRecorder {
 public:
  static constexpr bool kRecords = true;
  explicit LogRecorder(PathLog& log) : log_(log) {}

  void begin(Transport transport, Vec2 film) {
    log_.begin_path(film, transport);
    current_ = kNoVertex;
  }
  void film(Vec2 film) { log_.set_film(film); }
  void arrive(const GuidingVertex& vertex, Rgb throughput, std::uint32_t branch) {
    current_ = log_.add(RecordedVertex{.position = vertex.position,
                                       .normal = vertex.normal,
                                       .kind = vertex.kind,
                                       .parent = current_,
                                       .throughput = throughput,
                                       .branch = branch});
  }
  void emission(Rgb radiance, PathWeight weight) {
    current().emission += weight.own_end * radiance;
    current().joint_emission += weight.both_ends * radiance;
  }
  void leave(const LocalScattering& scattering, float roughness, const Guidance& guidance) {
    RecordedVertex& here = current();
    here.roughness = roughness;
    if (scattering.is_surface()) here.eta = scattering.bsdf().relative_ior();
    here.guidable = !scattering.purely_discrete();
    here.mixing_key = guidance.mixing_key;
  }
  void connect(const Connection& end, PathWeight weight, Rgb value, Rgb) {
    log_.add(RecordedLightSample{.vertex = current_,
                                 .position = end.position,
                                 .kind = end.kind,
                                 .event = end.event,
                                 .discrete = end.discrete,
                                 .direction = end.direction,
                                 .contribution = weight.own_end * value,
                                 .joint_contribution = weight.both_ends * value,
                                 .mis_weight = weight.own_end});
  }
  void step(const ScatterStep& step, const StepDensity& density, const Guidance& guidance,
            Rgb weight, const ResolvedVertex& target, Rgb transmittance) {
    RecordedVertex& here = current();
    here.event = step.event;
    here.direction = step.direction;
    here.local_weight = weight;
    here.continuation = step.continuation;
    here.pdf = density.total;
    here.mixing_key = guidance.mixing_key;
    here.guidable |= guidance.is_guided();
    here.medium_density = target.medium_density;
    here.transmittance = transmittance;
    std::array<Technique, GuidingSettings::kMostMethods + 1> techniques;
    log_.set_techniques(current_, guidance.techniques(target, density.unguided, techniques));
  }
  void contribute(Vec2, Rgb) {}

 private:
  RecordedVertex& current() { return log_.vertex(current_); }

  PathLog& log_;
  std::uint32_t current_ = kNoVertex;
};

}  // namespace pharos
