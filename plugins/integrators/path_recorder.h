#pragma once

#include <array>
#include <utility>

#include <pharos/guiding/record/path_record.h>
#include <pharos/rendering/scatter_step.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/sensor.h>

namespace pharos {

/// MIS weights of one way to make a path.
struct PathWeight {
  float own_end = 1;    ///< among the ways of paths from the sensor
  float both_ends = 1;  ///< among those of all paths
};

/// What a PathWalk reports to, call by call along the path. Nobody listens here: everything
/// compiles to nothing. Other recorders replace what they want to hear.
struct SilentRecorder {
  /// Whether vertices must be described in full.
  static constexpr bool kRecords = false;

  void lens(const LensPoint&, Vec2) {}
  void film(Vec2) {}
  void arrival(const GuidingVertex&, Rgb) {}
  void emission(Rgb, PathWeight) {}
  void light(const LightSample&, Event, PathWeight, Rgb, Rgb) {}
  void scattering(const LocalScattering&, float, const Guidance&) {}
  void step(const ScatterStep&, const StepDensity&, const Guidance&, Rgb, const ResolvedVertex&,
            Rgb) {}
};

/// Writes a PathLog.
class LogRecorder {
 public:
  static constexpr bool kRecords = true;
  explicit LogRecorder(PathLog& log) : log_(log) {}

  /// The path begins; `film` in pixels.
  void lens(const LensPoint& lens, Vec2 film) {
    log_.begin_path(film, Transport::radiance);
    current_ = kNoVertex;
    arrival({.position = lens.position,
             .normal = lens.normal,
             .shading_normal = lens.normal,
             .kind = VertexKind::sensor},
            Rgb(1));
  }

  /// A vertex is reached.
  void arrival(const GuidingVertex& vertex, Rgb throughput) {
    current_ = log_.add({.position = vertex.position,
                         .normal = vertex.normal,
                         .kind = vertex.kind,
                         .parent = current_,
                         .throughput = throughput});
  }

  /// The guide chose another place on the film [pixels].
  void film(Vec2 film) { log_.set_film(film); }

  /// Emission of the vertex and its MIS weights.
  void emission(Rgb radiance, PathWeight weight) {
    current().emission += weight.own_end * radiance;
    current().joint_emission += weight.both_ends * radiance;
  }

  /// Light found by next event estimation; `value` is f/p of the connection, without throughput.
  void light(const LightSample& light, Event event, PathWeight weight, Rgb value, Rgb) {
    log_.add({.vertex = current_,
              .position = light.point.position,
              .kind = light.kind,
              .event = event,
              .discrete = light.discrete,
              .direction = light.direction,
              .contribution = weight.own_end * value,
              .joint_contribution = weight.both_ends * value,
              .mis_weight = weight.own_end});
  }

  /// The path is about to go on from the vertex.
  void scattering(const LocalScattering& scattering, float roughness, const Guidance& guidance) {
    RecordedVertex& here = current();
    here.roughness = roughness;
    if (scattering.is_surface()) here.eta = scattering.bsdf().relative_ior();
    here.guidable = !scattering.purely_discrete();
    here.mixing_key = guidance.mixing_key;
  }

  /// The step from the vertex, once its `target` is known, through this transmittance.
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

 private:
  RecordedVertex& current() { return log_.vertex(current_); }

  PathLog& log_;
  std::uint32_t current_ = kNoVertex;
};

/// Keeps the contribution of the last light sample, throughput included, for the integrand probe.
class LightProbeRecorder : public SilentRecorder {
 public:
  void light(const LightSample&, Event, PathWeight weight, Rgb value, Rgb throughput) {
    last_ = throughput * (weight.own_end * value);
  }
  /// That contribution; black where there was none since take() was called last.
  Rgb take() { return std::exchange(last_, Rgb()); }

 private:
  Rgb last_;
};

}  // namespace pharos
