#pragma once

#include <array>
#include <utility>

#include <pharos/guiding/record/path_record.h>
#include <pharos/transport/path.h>

namespace pharos {

/// The MIS weights of one way to produce a path.
struct PathWeight {
  float own_end = 1;    ///< among the techniques of paths from the same end
  float both_ends = 1;  ///< among the techniques of all paths
  float unguided = 1;   ///< as `own_end` would be without guides; unknown if nothing is recorded
};

/// The end of a connection from a vertex: a point on a light, or on the lens.
struct Connection {
  Point3 position;
  VertexKind kind = VertexKind::surface;
  Vec3 direction;             ///< unit, from the vertex
  Event event = Event::none;  ///< event of scattering into `direction` at the vertex
  bool discrete = false;      ///< no step can hit the end, because it is a light without extent
  std::uint16_t copy = 0;     ///< number of the copy, if light samples split at the vertex
  float continuation = 1;     ///< weight of the copy; part of its value
};

/// The interface by which the transport kernel and the walks report events along a path. This
/// recorder ignores all events and compiles to nothing. Other recorders hide the functions for the
/// events that they use.
struct SilentRecorder {
  /// Whether the recorder needs full descriptions of vertices.
  static constexpr bool kRecords = false;

  /// Reports that a path begins. `film` is in pixels and unknown for paths from lights.
  void begin(Path&, Vec2 /*film*/) {}
  /// Reports that a guide of the camera chose this position on the film [pixels].
  void film(Vec2) {}
  /// Reports the reflectance [1] and the shading normal of the first surface that the sensor sees.
  void features(Rgb /*albedo*/, Vec3 /*normal*/) {}
  /// Reports that the path has reached its current vertex or begins there.
  void arrive(Path&) {}
  /// Reports emission of the current vertex.
  void emission(const Path&, Rgb /*radiance*/, PathWeight) {}
  /// Reports that the path is about to leave the current vertex.
  void leave(const Path&, const LocalScattering&, const Guidance&) {}
  /// Reports that each step from the current vertex is weighted by `continuation`, because the path
  /// splits or has survived roulette there; 0: the path ends.
  void weigh(const Path&, float /*continuation*/) {}
  /// Reports that `branch`, a copy of `trunk`, takes a step of its own from the current vertex.
  void split(const Path& /*trunk*/, Path& /*branch*/) {}
  /// Reports that lights are sampled `copies` times at the current vertex, each time with a light
  /// sample in each of `branches` branches.
  void lights(const Path&, std::uint32_t /*copies*/, std::uint32_t /*branches*/) {}
  /// Reports a connection from the current vertex. `value` is its f/p, without throughput.
  void connect(const Path&, const Connection&, PathWeight, Rgb /*value*/) {}
  /// Reports the step from the current vertex, once the next vertex is known.
  void step(const Path&, const ScatterStep&, const Guidance&, Rgb /*weight*/, const ResolvedVertex&,
            Rgb /*transmittance*/) {}
  /// Reports a contribution of a path from a light to the film [pixels], as FilmTile::add_splat()
  /// takes it.
  void contribute(Vec2 /*film*/, Rgb /*contribution*/) {}
};

/// Writes paths into a PathLog, one after another, until the log is full. Its only state of a path
/// in flight is Path::record, so that branches of a path can be recorded in turn.
class LogRecorder {
 public:
  static constexpr bool kRecords = true;
  explicit LogRecorder(PathLog& log) : log_(log) {}

  void begin(Path& path, Vec2 film) {
    is_on_ = log_.begin_path(film, path.transport);
    path.record = kNoVertex;
  }
  void film(Vec2 film) {
    if (is_on_) log_.set_film(film);
  }
  void features(Rgb albedo, Vec3 normal) {
    if (is_on_) log_.set_features(albedo, normal);
  }
  void arrive(Path& path) {
    if (!is_on_) return;
    path.record = log_.add_after(path.record);
    RecordedVertex& here = log_.vertex(path.record);
    here.position = path.current.position;
    here.normal = path.current.normal;
    here.kind = path.current.kind;
    here.throughput = path.throughput;
    here.branch = path.branch;
  }
  void emission(const Path& path, Rgb radiance, PathWeight weight) {
    if (!is_on_) return;
    RecordedVertex& here = log_.vertex(path.record);
    here.emission += weight.own_end * radiance;
    here.joint_emission += weight.both_ends * radiance;
    here.unguided_emission += weight.unguided * radiance;
  }
  void leave(const Path& path, const LocalScattering& scattering, const Guidance& guidance) {
    if (!is_on_) return;
    RecordedVertex& here = log_.vertex(path.record);
    here.roughness = path.current.roughness;
    if (scattering.is_surface()) here.eta = scattering.bsdf().relative_ior();
    here.guidable = !scattering.purely_discrete();
    here.mixing_key = guidance.mixing_key;
  }
  void weigh(const Path& path, float continuation) {
    if (is_on_) log_.vertex(path.record).continuation = continuation;
  }
  /// Records the vertex once more, without the light that was found there.
  void split(const Path& trunk, Path& branch) {
    if (!is_on_) return;
    const RecordedVertex first = log_.vertex(trunk.record);
    branch.record = log_.add_after(first.parent);
    RecordedVertex& twin = log_.vertex(branch.record);
    twin.position = first.position;
    twin.normal = first.normal;
    twin.kind = first.kind;
    twin.guidable = first.guidable;
    twin.roughness = first.roughness;
    twin.eta = first.eta;
    twin.throughput = first.throughput;
    twin.mixing_key = first.mixing_key;
    twin.continuation = first.continuation;
    twin.branch = branch.branch;
  }
  void lights(const Path& path, std::uint32_t copies, std::uint32_t branches) {
    if (!is_on_) return;
    log_.vertex(path.record).light_samples = copies * branches;
    log_.vertex(path.record).light_copies = copies;
  }
  void connect(const Path& path, const Connection& end, PathWeight weight, Rgb value) {
    if (!is_on_) return;
    log_.add(RecordedLightSample{.vertex = path.record,
                                 .position = end.position,
                                 .kind = end.kind,
                                 .event = end.event,
                                 .discrete = end.discrete,
                                 .copy = end.copy,
                                 .continuation = end.continuation,
                                 .direction = end.direction,
                                 .contribution = weight.own_end * value,
                                 .joint_contribution = weight.both_ends * value,
                                 .mis_weight = weight.own_end,
                                 .unguided_mis_weight = weight.unguided});
  }
  void step(const Path& path, const ScatterStep& step, const Guidance& guidance, Rgb weight,
            const ResolvedVertex& target, Rgb transmittance) {
    if (!is_on_) return;
    RecordedVertex& here = log_.vertex(path.record);
    here.event = step.event;
    here.direction = step.direction;
    here.local_weight = weight;
    here.continuation = step.continuation;
    here.pdf = path.arrival.total;
    here.mixing_key = guidance.mixing_key;
    here.guidable |= guidance.is_guided();
    here.medium_density = target.medium_density;
    here.transmittance = transmittance;
    std::array<Technique, GuidingSettings::kMostMethods + 1> techniques;
    log_.set_techniques(
        path.record, guidance.techniques(path.arrival.unguided, path.arrival.of_parts, techniques));
  }
  void contribute(Vec2, Rgb) {}

 private:
  PathLog& log_;
  bool is_on_ = true;  ///< the log takes the path that began last
};

}  // namespace pharos
