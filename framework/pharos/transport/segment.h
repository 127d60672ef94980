#pragma once

#include <cmath>

#include <pharos/rendering/integrator.h>
#include <pharos/scene/scene.h>
#include <pharos/transport/scatter_step.h>

namespace pharos {

/// The effect of media on light along a straight way.
struct Passage {
  Rgb transmittance{1};  ///< share of light that is left [1]
  /// Probability [1] with which the sampling of the media reaches the end; for a volume vertex, the
  /// density [1/m] of stopping there.
  float medium_density = 1;
};

/// The straight way from one vertex to the next.
struct Segment {
  VertexKind kind = VertexKind::surface;  ///< kind of its end: surface, volume or environment
  float length = 0;                       ///< infinite to the environment [scene units]
  const Medium* medium = nullptr;         ///< medium at its end; null: empty space
  Passage passage;
};

/// Traces rays through media and the boundaries between them. Surfaces that only let light pass
/// (Scene::is_boundary()) are not vertices; they only change the medium.
class SegmentTracer {
 public:
  SegmentTracer(const Scene& scene, RenderCounters& counters)
      : scene_(scene), counters_(counters) {}

  /// Traces a step from a vertex at `ray.origin`, in `medium`, as far as `step` says. Fills in
  /// `segment`, which must be new, and `end`: the whole point on a surface, otherwise its position.
  /// `throughput` is the path's throughput times the value of the step. Returns false if a proposed
  /// vertex cannot be reached.
  bool trace(const Ray& ray, const Medium* medium, const ScatterStep& step, Rgb throughput,
             const VertexStream& numbers, Segment& segment, SurfacePoint& end) const {
    if (scene_.has_media() || scene_.has_boundaries()) {
      return trace_through(ray, medium, step, throughput, numbers, segment, end);
    }
    if (step.reach == Proposal::Reach::distance) return false;
    ++counters_.rays;
    segment.length = scene_.intersect(ray, end);
    if (std::isinf(segment.length)) arrive_at_environment(ray, segment, end);
    return true;
  }

  /// Fills in `passage`, which must be new, with the effect of media on a shadow ray up to
  /// `ray.t_max`. `throughput` is the same as for trace(). Returns false if a surface is in the
  /// way.
  bool pass(const Ray& ray, const Medium* medium, Rgb throughput, Passage& passage) const {
    if (scene_.has_boundaries()) return pass_through(ray, medium, throughput, passage);
    ++counters_.rays;
    if (scene_.occluded(ray)) return false;
    if (medium != nullptr) add_leg(*medium, ray, channel_shares(throughput), passage);
    return true;
  }

 private:
  bool trace_through(Ray ray, const Medium* medium, const ScatterStep& step, Rgb throughput,
                     const VertexStream& numbers, Segment& segment, SurfacePoint& end) const;
  bool pass_through(Ray ray, const Medium* medium, Rgb throughput, Passage& passage) const;

  static void add_leg(const Medium& medium, const Ray& ray, Rgb shares, Passage& passage) {
    const MediumLeg passed = medium.leg(ray, shares, ray.t_max);
    passage.medium_density *= passed.pass_probability;
    passage.transmittance *= passed.transmittance;
  }
  void arrive_at_environment(const Ray& ray, Segment& segment, SurfacePoint& end) const {
    segment.kind = VertexKind::environment;
    end = {};
    end.position = scene_.environment_point(ray.origin, ray.direction);
  }

  const Scene& scene_;
  RenderCounters& counters_;
};

}  // namespace pharos
