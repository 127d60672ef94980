#pragma once

#include <optional>

#include <pharos/rendering/light_selection.h>
#include <pharos/rendering/scatter_step.h>
#include <pharos/rendering/segment.h>

namespace pharos {

/// What every light path of a render shares.
struct LightScene {
  const RenderTarget& target;
  const LightSelector& lights;  ///< of which one is chosen by its power
  std::uint16_t max_depth;      ///< segments, that to the lens included
};

/// One path from a light, vertex by vertex, each of which is seen by the sensor:
///
///     emission -> see the light -> [ advance -> connect to the lens -> step ] until it ends
///
/// `Listener` has `void contribute(Vec2 film, Rgb contribution)`, with positions in pixels and
/// contributions as FilmTile::add_splat() wants them, and `void arrive(VertexKind, Point3, Rgb
/// throughput)`.
template <class Listener>
class LightWalk {
 public:
  LightWalk(const LightScene& shared, const SampleStream& stream, RenderCounters& counters,
            Listener& listener)
      : shared_(shared),
        scene_(shared.target.scene),
        stream_(stream),
        counters_(counters),
        tracer_(scene_, counters),
        listener_(listener) {}

  void run() {
    ++counters_.paths;
    if (scene_.lights().empty()) return;
    std::optional<ScatterStep> step = emit();
    while (step && advance(*step) && kind_ != VertexKind::environment) {
      begin_scattering();
      if (!scattering_->purely_discrete()) connect();
      if (bounce_ + 1 >= shared_.max_depth) break;
      step = sample_unguided_step(*scattering_, {stream_, bounce_});
    }
  }

 private:
  // --- the light ------------------------------------------------------------------------------

  /// Draws a ray that leaves a light, and shows the light itself to the sensor.
  std::optional<ScatterStep> emit() {
    const int index = shared_.lights.choose(0, stream_.get_1d({Purpose::light_choice}));
    const Light& light = *scene_.lights()[static_cast<std::size_t>(index)];
    const float chosen = shared_.lights.probability(index);
    const EmissionSample emission = light.sample_emission(
        stream_.get_2d({Purpose::light_position}), stream_.get_2d({Purpose::bsdf_direction}));
    if (!(emission.pdf.direction > 0) || !(chosen > 0)) return std::nullopt;
    listener_.arrive(emission.kind, emission.point.position, Rgb(1));
    if (emission.kind == VertexKind::environment) {
      show_environment(light, emission, chosen);
    } else if (emission.kind == VertexKind::surface) {
      show_surface(light, emission, chosen);
    }
    if (shared_.max_depth < 2) return std::nullopt;
    leave(emission, chosen);
    if (is_black(throughput_)) return std::nullopt;
    return ScatterStep{.direction = emission.direction,
                       .event = Event::smooth_reflect,
                       .value = Rgb(1),
                       .unguided_pdf = 1,
                       .unguided_weight = Rgb(1)};
  }

  void leave(const EmissionSample& emission, float chosen) {
    throughput_ = emission.weight / chosen;
    kind_ = emission.kind;
    origin_ = emission.kind == VertexKind::surface
                  ? emission.point.origin_towards(emission.direction)
                  : emission.point.position;
    medium_ = emission.kind == VertexKind::surface ? medium_before(emission, emission.direction)
                                                   : scene_.medium_at(origin_);
    // What fills all of space lets nothing through from infinitely far away.
    if (emission.kind == VertexKind::environment && medium_ != nullptr) {
      throughput_ *= medium_->transmittance({origin_, -emission.direction}, kInfinity);
    }
  }

  /// An area light as it is seen from the lens.
  void show_surface(const Light& light, const EmissionSample& emission, float chosen) {
    const auto way = connection_from(emission.point.position);
    if (!way) return;
    const float cosine = dot(way->direction, emission.point.normal);
    if (!(cosine > 0)) return;
    const Rgb radiance = light.radiance(emission.point, way->direction);
    see(*way, emission.point.origin_towards(way->direction),
        medium_before(emission, way->direction),
        cosine / (emission.pdf.position * chosen) * radiance);
  }

  /// The medium that rays are in which leave a shining surface.
  const Medium* medium_before(const EmissionSample& emission, Vec3 direction) const {
    if (!scene_.has_media()) return nullptr;
    const Medium* around = scene_.medium_at(emission.point.origin_towards(direction));
    return scene_.medium_after(emission.point, direction, around);
  }

  /// The environment as it is seen from the lens, if there is a film position that sees it there.
  void show_environment(const Light& light, const EmissionSample& emission, float chosen) {
    if (!light.is_environment()) return;
    const RenderTarget& target = shared_.target;
    const LensPoint lens = target.sensor.sample_lens(stream_.get_2d({Purpose::lens}));
    const Vec3 towards = -emission.direction;
    const std::optional<SensorResponse> seen = target.sensor.response(lens, towards);
    if (!seen) return;
    const auto passage =
        tracer_.pass({lens.position, towards, kInfinity}, scene_.sensor_medium(), Rgb(1));
    if (!passage) return;
    const Rgb radiance = light.environment_radiance(towards);
    contribute(seen->film, seen->direction_pdf / (emission.pdf.direction * chosen) *
                               passage->transmittance * radiance);
  }

  // --- the lens -------------------------------------------------------------------------------

  std::optional<SensorConnection> connection_from(Point3 point) const {
    return shared_.target.sensor.connect(point, stream_.get_2d({Purpose::lens, bounce_}));
  }

  void connect() {
    const auto way = connection_from(end_.position);
    if (!way) return;
    const Rgb value = scattering_->evaluate(way->direction).value;
    if (is_black(value)) return;
    see(*way, origin_towards(way->direction), medium_towards(way->direction), throughput_ * value);
  }

  /// Light of this strength that leaves for the lens: radiance times cosine over the densities of
  /// all that led there.
  void see(const SensorConnection& way, Point3 origin, const Medium* medium, Rgb strength) {
    Ray ray{origin, way.direction, way.distance};
    const Vec3 span = way.lens.position - origin;
    ray.t_max = length(span);
    if (ray.t_max > 0) ray.direction = span / ray.t_max;
    const std::optional<Passage> passage = tracer_.pass(ray, medium, strength);
    if (passage) contribute(way.film, way.pdf * passage->transmittance * strength);
  }

  void contribute(Vec2 film, Rgb value) {
    const RenderTarget& target = shared_.target;
    const auto pixels = static_cast<float>(target.window.area());
    listener_.contribute(
        {film.x * static_cast<float>(target.width), film.y * static_cast<float>(target.height)},
        pixels * value);
  }

  // --- from vertex to vertex ------------------------------------------------------------------

  /// Traces a step to the next vertex and weights it. False when the path ends with value zero.
  bool advance(const ScatterStep& step) {
    const Ray ray{origin_towards(step.direction), step.direction};
    const Medium* medium = medium_towards(step.direction);
    const auto segment =
        tracer_.trace(ray, medium, step, throughput_ * step.value, {stream_, bounce_}, end_);
    if (!segment) return false;
    const Passage& passage = segment->passage;
    throughput_ *= step.unguided_weight;
    if (!(passage.medium_density > 0)) return false;
    if (scene_.has_media()) throughput_ *= passage.transmittance / passage.medium_density;
    kind_ = segment->kind;
    medium_ = segment->medium;
    origin_ = end_.position;
    towards_previous_ = -step.direction;
    ++bounce_;
    listener_.arrive(kind_, end_.position, throughput_);
    return !is_black(throughput_);
  }

  void begin_scattering() {
    if (kind_ == VertexKind::surface) {
      scattering_.emplace(end_, scene_.bsdf(end_), towards_previous_, Transport::importance);
    } else {
      scattering_.emplace(medium_->phase_function(), medium_->scattering(end_.position),
                          towards_previous_, Transport::importance);
    }
  }

  /// Where a ray begins that leaves the current vertex, and the medium that it is in.
  Point3 origin_towards(Vec3 direction) const {
    return is_on_surface() ? end_.origin_towards(direction) : origin_;
  }
  const Medium* medium_towards(Vec3 direction) const {
    return is_on_surface() ? scene_.medium_after(end_, direction, medium_) : medium_;
  }
  /// Rays leave a light's surface from `origin_`, in `medium_`.
  bool is_on_surface() const { return bounce_ > 0 && kind_ == VertexKind::surface; }

  const LightScene& shared_;
  const Scene& scene_;
  const SampleStream& stream_;
  RenderCounters& counters_;
  SegmentTracer tracer_;
  Listener& listener_;

  Rgb throughput_{1};         ///< power that the path stands for [W], then times f/p
  std::uint16_t bounce_ = 0;  ///< number of the current vertex; 0 on the light
  VertexKind kind_ = VertexKind::light;
  SurfacePoint end_;  ///< the current vertex beyond the light; volume vertices: its position
  Point3 origin_;     ///< where rays leave vertices that are on no surface
  const Medium* medium_ = nullptr;  ///< that the path came through
  Vec3 towards_previous_;
  std::optional<LocalScattering> scattering_;
};

}  // namespace pharos
